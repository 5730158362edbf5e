#include "ponte/mavlink/signing_store.hpp"

#include <optional>

namespace ponte::mavlink {
namespace {

constexpr std::size_t half = signing_slot_size / 2;

std::optional<SigningTime> read_slot(Bytes store, std::size_t slot) {
  if (store.size() < (slot + 1) * signing_slot_size) return {};
  const auto* const at = &store[slot * signing_slot_size];
  const auto time = load_le<std::uint64_t>(at);
  if (load_le<std::uint64_t>(at + half) != ~time) return {};
  return SigningTime{time};
}

}  // namespace

std::array<std::byte, signing_slot_size> write_signing_slot(SigningTime time) {
  std::array<std::byte, signing_slot_size> slot{};
  store_le(slot.data(), time.value);
  store_le(&slot[half], ~time.value);
  return slot;
}

StoredSigningTime read_signing_store(Bytes store) {
  if (store.empty()) return {};
  const auto first = read_slot(store, 0);
  const auto second = read_slot(store, 1);
  const bool is_first_newer = first >= second;  // nothing is older than everything
  return {.time = (is_first_newer ? first : second).value_or(SigningTime{}),
          .next_slot = is_first_newer ? std::size_t{1} : std::size_t{0},
          .damaged = !first || !second || store.size() != signing_store_size};
}

}  // namespace ponte::mavlink
