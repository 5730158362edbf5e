#include "ponte/core/hex.hpp"
#include "ponte/core/random.hpp"
#include "ponte/mavlink/crc.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/mavlink/test_messages.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

// Properties of the parser over random traffic: what damage to some frames does to the others, and how little it
// matters in which pieces a stream arrives.
namespace ponte::mavlink {
namespace {

using Buffer = std::vector<std::byte>;

/// Where frames are in a stream.
struct Place {
  std::size_t offset;
  std::size_t size;
  friend auto operator<=>(const Place&, const Place&) = default;
};

struct Traffic {
  Buffer stream;
  std::vector<Place> frames;
};

void append_random_frame(Random& random, const MessageInfo& message, Buffer& stream) {
  std::array<std::byte, max_frame_size> out{};
  Buffer payload(message.full_length);
  random.fill(payload);
  if (random.chance(0.3)) std::fill_n(payload.rbegin(), payload.size() / 2, std::byte{0});
  FrameHeader header{};
  if (message.is_v09())
    header.version = Version::v0_9;
  else if (message.id.value < 256 && random.chance(0.4))
    header.version = Version::v1;
  header.system = SystemId{static_cast<std::uint8_t>(random.below(256))};
  header.component = ComponentId{static_cast<std::uint8_t>(random.below(256))};
  header.sequence = static_cast<std::uint8_t>(random.below(256));
  auto size = write_frame(header, message, payload, out).value();
  if (header.version == Version::v2 && random.chance(0.2)) {
    out[2] = std::byte{1};
    const auto covered = Bytes{out}.subspan(1, size - 3);
    store_le(&out[size - 2], crc_of(message.crc_extra, crc_of(covered)));
    random.fill(std::span{out}.subspan(size, signature_size));
    size += signature_size;
  }
  stream.insert(stream.end(), out.begin(), out.begin() + static_cast<std::ptrdiff_t>(size));
}

/// Of all versions.
const MessageInfo& random_message(Random& random) {
  const auto index = random.below(testing::messages.size() + testing::messages_v09.size());
  return index < testing::messages.size() ? *testing::messages[index]
                                          : *testing::messages_v09[index - testing::messages.size()];
}

Traffic make_traffic(Random& random, int count) {
  Traffic traffic;
  for (int i = 0; i < count; ++i) {
    const auto offset = traffic.stream.size();
    append_random_frame(random, random_message(random), traffic.stream);
    traffic.frames.push_back({offset, traffic.stream.size() - offset});
  }
  return traffic;
}

/// Changes one byte in a hundred, and keeps of the list of frames those that are untouched.
Traffic with_changes(Random& random, const Traffic& traffic) {
  Traffic result{traffic.stream, {}};
  for (const auto& frame : traffic.frames) {
    bool untouched = true;
    for (std::size_t at = frame.offset; at < frame.offset + frame.size; ++at) {
      if (!random.chance(0.01)) continue;
      result.stream[at] ^= static_cast<std::byte>(1 + random.below(255));
      untouched = false;
    }
    if (untouched) result.frames.push_back(frame);
  }
  return result;
}

/// Leaves out one byte in a hundred, and keeps the frames that are untouched, at their new places. When one of several
/// equal bytes in a row goes missing, nobody can tell which: it counts as the last of them, which may belong to the
/// next frame.
Traffic with_losses(Random& random, const Traffic& traffic) {
  const auto& stream = traffic.stream;
  std::vector<char> is_lost(stream.size());
  for (std::size_t begin = 0; begin < stream.size();) {
    std::size_t end = begin;
    std::size_t lost = 0;
    for (; end < stream.size() && stream[end] == stream[begin]; ++end)
      if (random.chance(0.01)) ++lost;
    std::fill_n(is_lost.begin() + static_cast<std::ptrdiff_t>(end - lost), lost, char{1});
    begin = end;
  }
  Traffic result;
  for (const auto& frame : traffic.frames) {
    const auto offset = result.stream.size();
    for (std::size_t at = frame.offset; at < frame.offset + frame.size; ++at)
      if (is_lost[at] == 0) result.stream.push_back(stream[at]);
    if (result.stream.size() - offset == frame.size) result.frames.push_back({offset, frame.size});
  }
  return result;
}

/// Remembers where frames were found, and checks each of them as it comes.
struct Finder : FrameSink {
  void on_frame(const FrameView& frame, const MessageInfo* message) override {
    if (message != nullptr && !checksum_matches(frame, message->crc_extra)) ++wrong_checksums;
    (message != nullptr ? known : unknown).push_back({position, frame.whole.size()});
    position += frame.whole.size();
  }
  void on_overlap(std::size_t shared) override { position -= shared; }
  void on_skipped(Bytes run, SkipReason /*reason*/) override { position += run.size(); }

  std::vector<Place> known;
  std::vector<Place> unknown;
  std::size_t position{};
  std::size_t wrong_checksums{};
};

struct Outcome {
  Finder found;
  ParserCounters counters;
};

template <class NextSize>
Outcome parse_in_pieces(Bytes stream, NextSize next_size) {
  Parser parser{testing::dialect};
  Outcome outcome;
  while (!stream.empty()) {
    const auto size = std::min<std::size_t>(stream.size(), next_size());
    // A copy of just this size lets the address sanitizer notice a single byte read too far.
    const Buffer piece(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(size));
    parser.on_bytes(Timestamp{}, piece, outcome.found);
    stream = stream.subspan(size);
  }
  parser.finish(outcome.found);
  outcome.counters = parser.counters();
  return outcome;
}

std::vector<Place> missing(const std::vector<Place>& wanted, const std::vector<Place>& found) {
  std::vector<Place> result;
  std::set_difference(wanted.begin(), wanted.end(), found.begin(), found.end(), std::back_inserter(result));
  return result;
}

constexpr int many = 100'000;

void expect_untouched_frames(const Traffic& damaged, std::uint64_t seed) {
  ASSERT_GT(damaged.frames.size(), many / 4U);
  for (const std::size_t piece : {1U, 7U, 100U, 1500U, 65536U}) {
    const auto outcome = parse_in_pieces(damaged.stream, [&] { return piece; });
    EXPECT_EQ(missing(damaged.frames, outcome.found.known).size(), 0U) << "seed " << seed << ", pieces of " << piece;
    EXPECT_EQ(outcome.found.wrong_checksums, 0U) << "seed " << seed << ", pieces of " << piece;
    EXPECT_EQ(outcome.found.position, damaged.stream.size()) << "seed " << seed << ", pieces of " << piece;
  }
}

TEST(ParserInNoiseSeeded, LosesNoUntouchedFrameWhenBytesChange) {
  const auto seed = chosen_seed();
  Random random{seed};
  expect_untouched_frames(with_changes(random, make_traffic(random, many)), seed);
}

TEST(ParserInNoiseSeeded, LosesNoUntouchedFrameWhenBytesGetLost) {
  const auto seed = chosen_seed();
  Random random{seed};
  expect_untouched_frames(with_losses(random, make_traffic(random, many)), seed);
}

TEST(ParserInNoiseSeeded, DeliversCleanTrafficWholly) {
  const auto seed = chosen_seed();
  Random random{seed};
  const auto traffic = make_traffic(random, 20'000);
  const auto outcome = parse_in_pieces(traffic.stream, [] { return std::size_t{1500}; });
  EXPECT_EQ(outcome.found.known, traffic.frames) << "seed " << seed;
  EXPECT_EQ(outcome.counters.bytes, traffic.stream.size()) << "seed " << seed;
}

/// Traffic as hostile as chance makes it: frames of messages known and unknown, whole and cut off, many start bytes,
/// and damage.
Buffer hostile_stream(Random& random) {
  constexpr MessageInfo stranger{MessageId{109}, "RADIO_STATUS", 185, 9, 9, {}};
  static constexpr std::array<FieldInfo, 1> byte_field{
      {{"", FieldType::uint8, 9, 0, false, "", "", nullptr, false, true}}};
  constexpr MessageInfo old_stranger{MessageId{110}, "", 0, 9, 9, byte_field};
  Buffer stream;
  for (int i = 0; i < 40; ++i) {
    const auto kind = random.below(9);
    if (kind < 3) append_random_frame(random, random_message(random), stream);
    if (kind >= 3 && kind < 6) append_random_frame(random, random.chance(0.3) ? old_stranger : stranger, stream);
    if (kind == 6)
      for (auto size = random.below(30); size > 0; --size)
        stream.push_back(random.chance(0.5) ? random.byte() : static_cast<std::byte>(0xFD + random.below(2)));
    if (kind == 7) stream.insert(stream.end(), {start_v2, static_cast<std::byte>(random.below(256)), std::byte{0}});
    if (kind == 8) {
      const auto cut = std::min<std::size_t>(stream.size(), random.below(14));
      stream.erase(stream.end() - static_cast<std::ptrdiff_t>(cut), stream.end());
    }
  }
  for (auto& byte : stream)
    if (random.chance(0.003)) byte = random.byte();
  return stream;
}

TEST(ParserInNoiseSeeded, FindsTheSameInWhateverPiecesTheStreamArrives) {
  const auto first_seed = chosen_seed();
  std::uint64_t overlaps = 0;
  for (auto seed = first_seed; seed < first_seed + 400; ++seed) {
    Random random{seed};
    const auto stream = hostile_stream(random);
    const auto whole = parse_in_pieces(stream, [&] { return stream.size(); });
    const auto single = parse_in_pieces(stream, [] { return std::size_t{1}; });
    const auto mixed = parse_in_pieces(stream, [&] { return std::size_t{1 + random.below(400)}; });
    for (const auto* other : {&single, &mixed}) {
      ASSERT_EQ(whole.found.known, other->found.known) << "seed " << seed;
      ASSERT_EQ(whole.found.unknown, other->found.unknown) << "seed " << seed;
      ASSERT_EQ(whole.counters, other->counters) << "seed " << seed;
    }
    ASSERT_EQ(whole.counters.bytes, stream.size()) << "seed " << seed;
    overlaps += whole.counters.overlaps;
  }
  EXPECT_GT(overlaps, 0U) << "seeds from " << first_seed;
}

TEST(ParserInNoiseSeeded, DecidesWithEachByteAllThatCanBeDecided) {
  const auto first_seed = chosen_seed();
  for (auto seed = first_seed; seed < first_seed + 150; ++seed) {
    Random random{seed};
    const auto stream = hostile_stream(random);
    Parser single{testing::dialect};
    Finder found;
    for (std::size_t size = 1; size <= stream.size(); ++size) {
      single.on_bytes(Timestamp{}, Bytes{stream}.subspan(size - 1, 1), found);
      Parser at_once{testing::dialect};
      Finder ignored;
      at_once.on_bytes(Timestamp{}, Bytes{stream}.first(size), ignored);
      ASSERT_EQ(single.counters(), at_once.counters()) << "seed " << seed << ", after " << size << " bytes";
    }
  }
}

}  // namespace
}  // namespace ponte::mavlink
