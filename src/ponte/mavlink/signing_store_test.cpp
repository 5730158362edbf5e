#include "ponte/mavlink/signing_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace ponte::mavlink {
namespace {

/// Writes the next slot as the shell does, but only its first `written` bytes.
void store(std::vector<std::byte>& file, SigningTime time, std::size_t written = signing_slot_size) {
  const auto at = read_signing_store(file).next_slot * signing_slot_size;
  const auto slot = write_signing_slot(time);
  file.resize(std::max(file.size(), at + written));
  std::copy_n(slot.begin(), written, file.begin() + static_cast<std::ptrdiff_t>(at));
}

TEST(SigningStore, BeginsAtZero) {
  const auto stored = read_signing_store({});
  EXPECT_EQ(stored.time, SigningTime{});
  EXPECT_FALSE(stored.damaged);
}

TEST(SigningStore, GivesTheNewestTimeThatWasWritten) {
  std::vector<std::byte> file;
  for (const std::uint64_t time : {5ULL, 6ULL, 7ULL, 0x0123456789abULL}) {
    store(file, SigningTime{time});
    EXPECT_EQ(read_signing_store(file).time, SigningTime{time});
  }
  EXPECT_EQ(file.size(), signing_store_size);
  EXPECT_FALSE(read_signing_store(file).damaged);
}

TEST(SigningStore, RecoversFromWritingThatWasInterruptedAnywhere) {
  for (std::size_t times = 0; times < 4; ++times) {
    std::vector<std::byte> before;
    for (std::uint64_t i = 1; i <= times; ++i) store(before, SigningTime{i * 0x01010101});
    for (std::size_t written = 0; written < signing_slot_size; ++written) {
      auto file = before;
      store(file, SigningTime{0x9988776655443322}, written);
      const auto stored = read_signing_store(file);
      EXPECT_EQ(stored.time, SigningTime{times * 0x01010101}) << times << ", " << written;
      store(file, SigningTime{0xAA99887766554433});
      EXPECT_EQ(read_signing_store(file).time, SigningTime{0xAA99887766554433}) << times << ", " << written;
    }
  }
}

}  // namespace
}  // namespace ponte::mavlink
