#include "ponte/mavlink/tlog.hpp"

#include "ponte/core/hex.hpp"
#include "ponte/core/random.hpp"
#include "ponte/mavlink/test_messages.hpp"
#include "support/bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace ponte::mavlink {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

using Buffer = std::vector<std::byte>;

const Buffer heartbeat = bytes(testing::heartbeat_frame);
const Buffer heartbeat_signed = bytes(testing::heartbeat_signed_frame);
const Buffer attitude = bytes(testing::attitude_frame);
const Buffer unknown = bytes(testing::radio_status_frame);

constexpr std::int64_t second = 1'000'000;
constexpr std::int64_t day = 86'400 * second;
constexpr std::int64_t noon = 1'700'000'000 * second;

Buffer record_of(std::int64_t time_us, const Buffer& frame) {
  Buffer record;
  append_record(record, wall_time_from_unix_us(time_us), frame);
  return record;
}

Buffer operator+(Buffer a, const Buffer& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Reading {
  std::vector<TlogRecord> records;
  std::vector<TlogDamage> damages;

  [[nodiscard]] std::vector<std::size_t> offsets() const {
    std::vector<std::size_t> result;
    for (const auto& record : records) result.push_back(record.offset);
    return result;
  }
};

/// Reads all of the file, and checks that what comes out covers it without a gap. The file must stay for the views.
Reading read(const Buffer& file) {
  TlogReader reader{file, testing::dialect};
  Reading reading;
  std::size_t position = 0;
  while (const auto part = reader.next()) {
    if (const auto* record = std::get_if<TlogRecord>(&*part)) {
      EXPECT_EQ(record->offset, position);
      position += 8 + record->frame.whole.size();
      reading.records.push_back(*record);
    } else {
      const auto& damage = std::get<TlogDamage>(*part);
      EXPECT_EQ(damage.offset, position);
      EXPECT_GT(damage.length, 0U);
      position += damage.length;
      reading.damages.push_back(damage);
    }
  }
  EXPECT_EQ(position, file.size());
  return reading;
}

TEST(TlogReader, ReadsWhatWasAppended) {
  const auto file = record_of(noon, heartbeat) + record_of(noon + 1, unknown) + record_of(noon + 2, attitude);
  const auto reading = read(file);
  ASSERT_THAT(reading.records, SizeIs(3));
  EXPECT_EQ(unix_us(reading.records[0].time), noon);
  EXPECT_EQ(reading.records[0].message, &testing::Heartbeat::info);
  EXPECT_EQ(to_hex(reading.records[0].frame.whole), to_hex(heartbeat));
  EXPECT_EQ(reading.records[1].message, nullptr);
  EXPECT_EQ(reading.records[1].offset, 8 + heartbeat.size());
  EXPECT_EQ(unix_us(reading.records[2].time), noon + 2);
  EXPECT_THAT(reading.damages, IsEmpty());
}

TEST(TlogReader, FindsNothingInAnEmptyFile) { EXPECT_THAT(read({}).records, IsEmpty()); }

TEST(TlogReader, TakesAnyTimesInAnUndamagedRow) {
  const auto file = record_of(0, heartbeat) + record_of(noon, heartbeat) + record_of(-noon, heartbeat) +
                    record_of(noon + 400 * day, heartbeat);
  EXPECT_THAT(read(file).records, SizeIs(4));
}

TEST(TlogReader, FindsNoRecordInOtherFiles) {
  Buffer text;
  for (int i = 0; i < 40; ++i) text = text + bytes("54 68 65 20 71 75 69 63 6b 0a");
  EXPECT_THAT(read(text).damages, ElementsAre(TlogDamage{0, text.size(), TlogDamageReason::no_frame}));
  const Buffer zeros(5);
  EXPECT_THAT(read(zeros).damages, ElementsAre(TlogDamage{0, 5, TlogDamageReason::truncated}));
}

TEST(TlogReader, SaysWhereTheLastRecordWasCut) {
  const auto first = record_of(noon, heartbeat);
  const auto second_record = record_of(noon, attitude);
  for (std::size_t size = 1; size < second_record.size(); ++size) {
    const auto file = first + Buffer(second_record.begin(), second_record.begin() + static_cast<std::ptrdiff_t>(size));
    const auto reading = read(file);
    EXPECT_THAT(reading.records, SizeIs(1));
    EXPECT_THAT(reading.damages, ElementsAre(TlogDamage{first.size(), size, TlogDamageReason::truncated}));
  }
}

TEST(TlogReader, GivesUpOneRecordForAWrongChecksum) {
  auto broken = record_of(noon + 1, attitude);
  broken[30] ^= std::byte{1};
  const auto first = record_of(noon, heartbeat);
  const auto file = first + broken + record_of(noon + 2, heartbeat);
  const auto reading = read(file);
  EXPECT_THAT(reading.offsets(), ElementsAre(0, first.size() + broken.size()));
  EXPECT_THAT(reading.damages, ElementsAre(TlogDamage{first.size(), broken.size(), TlogDamageReason::checksum}));
}

TEST(TlogReader, GivesUpTheLastRecordForAWrongChecksum) {
  auto broken = record_of(noon + 1, attitude);
  broken[30] ^= std::byte{1};
  const auto file = record_of(noon, heartbeat) + broken;
  EXPECT_THAT(read(file).damages,
              ElementsAre(TlogDamage{8 + heartbeat.size(), broken.size(), TlogDamageReason::checksum}));
}

TEST(TlogReader, ReadsTheRecordThatAWrongLengthJumpsOver) {
  // The length is wrong by just the size of the next record, so that a third one follows where it leads to.
  const auto first = record_of(noon, heartbeat);
  auto broken = first;
  broken[9] = static_cast<std::byte>(9 + first.size());
  const auto file = first + broken + first + first;
  const auto reading = read(file);
  EXPECT_THAT(reading.offsets(), ElementsAre(0, 2 * first.size(), 3 * first.size()));
  EXPECT_THAT(reading.damages, ElementsAre(TlogDamage{first.size(), first.size(), TlogDamageReason::checksum}));
}

TEST(TlogReader, ReadsTheLastRecordsWhenALengthReachesBeyondThem) {
  const auto first = record_of(noon, heartbeat);
  auto broken = first;
  broken[9] = std::byte{0xFF};
  const auto file = broken + first + first;
  EXPECT_THAT(read(file).offsets(), ElementsAre(first.size(), 2 * first.size()));
}

TEST(TlogReader, FindsTheNextRecordBehindGarbage) {
  const auto first = record_of(noon, heartbeat);
  for (std::size_t size = 1; size < 80; ++size) {
    Random random{size};
    Buffer garbage(size);
    random.fill(garbage);
    garbage[random.below(static_cast<std::uint32_t>(size))] = start_v2;
    const auto file = first + garbage + first + first;
    const auto reading = read(file);
    EXPECT_THAT(reading.offsets(), ElementsAre(0, first.size() + size, 2 * first.size() + size)) << size << " bytes";
  }
}

TEST(TlogReader, FindsTheFirstRecordBehindGarbageAtTheBeginning) {
  const auto record = record_of(noon, heartbeat);
  const auto garbage = bytes("89 50 4e 47 fd fe 0d 0a 1a");
  EXPECT_THAT(read(garbage + record).offsets(), ElementsAre(garbage.size())) << "it has no neighbour at all";
  EXPECT_THAT(read(garbage + record_of(noon, heartbeat) + garbage + record_of(noon + day, heartbeat)).offsets(),
              ElementsAre(garbage.size(), 2 * garbage.size() + record.size()));
}

TEST(TlogReader, DoesNotTakeAShiftedTimeForOne) {
  // The frame of the middle record is whole, but a byte of its time is missing.
  const auto first = record_of(noon, heartbeat);
  for (std::ptrdiff_t missing = 0; missing < 8; ++missing) {
    auto middle = record_of(noon + 1, attitude);
    middle.erase(middle.begin() + missing);
    const auto file = first + middle + record_of(noon + 2, heartbeat);
    EXPECT_THAT(read(file).offsets(), ElementsAre(0, first.size() + middle.size())) << "byte " << missing;
  }
}

TEST(TlogReader, FollowsATimeThatJumpsBehindDamage) {
  const auto garbage = bytes("00 11 22 33 44");
  const auto file = record_of(noon, heartbeat) + garbage + record_of(0, heartbeat) + record_of(1, heartbeat);
  EXPECT_THAT(read(file).records, SizeIs(3));
}

TEST(TlogReader, TakesAnUnknownMessageAtTheEndOrBeforeAnotherRecord) {
  const auto first = record_of(noon, heartbeat);
  EXPECT_THAT(read(first + record_of(noon, unknown)).records, SizeIs(2));
  EXPECT_THAT(read(record_of(noon, unknown) + record_of(noon, unknown) + first).records, SizeIs(3));
  EXPECT_THAT(read(first + record_of(noon, unknown) + record_of(noon + 2 * day, heartbeat)).records, SizeIs(3));

  const auto garbage = bytes("11 22 33 44 55 66 77 88 99");
  const auto file = first + record_of(noon, unknown) + garbage + first;
  EXPECT_THAT(read(file).records, SizeIs(2)) << "nothing proves it";
}

TEST(TlogReader, FindsAnUnknownMessageBehindGarbage) {
  const auto first = record_of(noon, heartbeat);
  const auto garbage = bytes("11 22 33 44 55 66 77 88 99");
  EXPECT_THAT(read(first + garbage + record_of(noon, unknown) + first).records, SizeIs(3));
}

TEST(TlogReader, LosesNoRecordWhenTheSignatureBeforeItWasCut) {
  const auto cut = Buffer(heartbeat_signed.begin(), heartbeat_signed.end() - 2);
  const auto first = record_of(noon, cut);
  const auto file = first + record_of(noon, attitude) + record_of(noon, attitude);
  EXPECT_THAT(read(file).offsets(), ElementsAre(first.size(), first.size() + 8 + attitude.size()));
}

struct Recording {
  Buffer bytes;
  std::vector<std::size_t> ends;
};

Recording random_recording(Random& random, int count) {
  Recording recording;
  auto time = static_cast<std::int64_t>(random.next() >> 2U);
  for (int i = 0; i < count; ++i) {
    const auto& message = *testing::messages[random.below(testing::messages.size())];
    Buffer payload(message.full_length);
    random.fill(payload);
    std::array<std::byte, max_frame_size> out{};
    const auto size = write_frame({.sequence = static_cast<std::uint8_t>(i)}, message, payload, out).value();
    time += random.below(100'000);
    append_record(recording.bytes, wall_time_from_unix_us(time), Bytes{out}.first(size));
    recording.ends.push_back(recording.bytes.size());
  }
  return recording;
}

TEST(TlogReader, LosesNoUntouchedRecordWhenBytesChange) {
  Random random{21};
  const auto recording = random_recording(random, 20'000);
  auto damaged = recording.bytes;
  std::vector<std::size_t> untouched;
  std::size_t begin = 0;
  for (const auto end : recording.ends) {
    bool is_touched = false;
    for (auto at = begin; at < end; ++at) {
      if (!random.chance(0.005)) continue;
      damaged[at] ^= static_cast<std::byte>(1 + random.below(255));
      is_touched = true;
    }
    if (!is_touched) untouched.push_back(begin);
    begin = end;
  }
  const auto found = read(damaged).offsets();
  ASSERT_GT(untouched.size(), 10'000U);
  EXPECT_TRUE(std::includes(found.begin(), found.end(), untouched.begin(), untouched.end()));
}

TEST(TlogReader, LosesNoUntouchedRecordWhenBytesGetLost) {
  Random random{22};
  const auto recording = random_recording(random, 20'000);
  Buffer damaged;
  std::vector<std::size_t> untouched;
  std::size_t begin = 0;
  for (const auto end : recording.ends) {
    const auto offset = damaged.size();
    // A byte that equals its neighbour in the next record might as well be the one that is left: none of those is lost.
    for (auto at = begin; at < end; ++at)
      if (at + 1 == end || !random.chance(0.005)) damaged.push_back(recording.bytes[at]);
    if (damaged.size() - offset == end - begin) untouched.push_back(offset);
    begin = end;
  }
  const auto found = read(damaged).offsets();
  ASSERT_GT(untouched.size(), 10'000U);
  EXPECT_TRUE(std::includes(found.begin(), found.end(), untouched.begin(), untouched.end()));
}

}  // namespace
}  // namespace ponte::mavlink
