#include "ponte/mavlink/tlog.hpp"

#include <algorithm>
#include <array>
#include <chrono>

namespace ponte::mavlink {
namespace {

constexpr std::size_t stamp_size = 8;
constexpr std::size_t neighbourhood = 4096;
constexpr auto close_times = std::chrono::days{1};

std::size_t end_of(const TlogRecord& record) { return record.offset + stamp_size + record.frame.whole.size(); }

/// Time stamps found in garbage may lie anywhere in 64 bits, too far apart for a signed difference.
bool are_close(WallTime a, WallTime b) {
  const auto earlier = static_cast<std::uint64_t>(unix_us(std::min(a, b)));
  const auto later = static_cast<std::uint64_t>(unix_us(std::max(a, b)));
  return later - earlier <= static_cast<std::uint64_t>(std::chrono::microseconds{close_times}.count());
}

}  // namespace

std::optional<std::variant<TlogRecord, TlogDamage>> TlogReader::next() {
  if (at_ == file_.size()) return std::nullopt;
  const auto record = record_shape_at(at_);
  if (record && is_intact(*record)) {
    at_ = end_of(*record);
    last_time_ = record->time;
    return *record;
  }

  const bool is_wrong = record && record->message != nullptr && !is_good(*record);
  const auto reason = is_wrong ? TlogDamageReason::checksum : TlogDamageReason::no_frame;
  if (record && is_followed_well(*record)) {
    // A wrong length may have led to a record further behind: the one that was jumped over comes first.
    const auto end = end_of(*record);
    return damage(find_record(at_ + 1, end).value_or(end), reason);
  }
  if (const auto found = find_record(at_ + 1, file_.size())) return damage(*found, reason);
  const bool reaches_beyond_end =
      file_.size() - at_ <= stamp_size || parse_frame(file_.subspan(at_ + stamp_size)) == fail(FrameError::incomplete);
  return damage(file_.size(), reaches_beyond_end ? TlogDamageReason::truncated : reason);
}

/// The record whose time stamp begins at `offset`, if a whole frame follows it. Its checksum is not examined.
std::optional<TlogRecord> TlogReader::record_shape_at(std::size_t offset) const {
  if (file_.size() - offset <= stamp_size) return std::nullopt;
  const auto frame = parse_frame(file_.subspan(offset + stamp_size));
  if (!frame) return std::nullopt;
  return TlogRecord{
      .offset = offset,
      .time = wall_time_from_unix_us(static_cast<std::int64_t>(u64_be(file_, offset))),
      .frame = *frame,
      .message = find_message(*dialect_, *frame),
  };
}

bool TlogReader::is_good(const TlogRecord& record) const {
  return record.message != nullptr && checksum_matches(record.frame, record.message->crc_extra);
}

/// Whether the file ends behind this record, or something goes on there that can be the next record.
bool TlogReader::is_followed_well(const TlogRecord& record) const {
  const auto end = end_of(record);
  if (file_.size() - end <= stamp_size) return true;
  const auto frame = parse_frame(file_.subspan(end + stamp_size));
  if (!frame && frame.error() != FrameError::incomplete) return false;
  if (are_close(record.time, wall_time_from_unix_us(static_cast<std::int64_t>(u64_be(file_, end))))) return true;
  const auto next = record_shape_at(end);
  return next && is_good(*next);
}

/// Whether the time of this record fits to that of a record before or behind it, if there is any.
bool TlogReader::has_close_neighbour(const TlogRecord& record) const {
  if (last_time_ && are_close(*last_time_, record.time)) return true;
  bool is_alone = !last_time_;
  const auto begin = end_of(record);
  const auto end = std::min(file_.size(), begin + neighbourhood);
  for (auto at = begin; at < end; ++at) {
    const auto other = record_shape_at(at);
    if (!other || !is_good(*other)) continue;
    if (are_close(record.time, other->time)) return true;
    is_alone = false;
  }
  return is_alone;
}

/// Whether this record, found where one was expected, is what it seems.
bool TlogReader::is_intact(const TlogRecord& record) const {
  const auto end = end_of(record);
  if (record.message == nullptr) return is_followed_well(record) && !find_record(record.offset + 1, end);
  // The checksum does not cover a signature: if some of it got lost, the next record begins inside.
  return is_good(record) && !(record.frame.is_signed() && find_record(end - signature_size, end));
}

/// The first place from `first` to before `last` where an intact record begins, although none was expected there.
std::optional<std::size_t> TlogReader::find_record(std::size_t first, std::size_t last) const {
  for (auto at = first; at < last && file_.size() - at > stamp_size; ++at) {
    at += find_start(file_.subspan(at + stamp_size));
    if (at >= last || file_.size() - at <= stamp_size) break;
    const auto record = record_shape_at(at);
    if (!record) continue;
    const bool is_proven = record->message != nullptr ? is_good(*record) : is_followed_well(*record);
    if (is_proven && has_close_neighbour(*record)) return at;
  }
  return std::nullopt;
}

TlogDamage TlogReader::damage(std::size_t end, TlogDamageReason reason) {
  const auto begin = at_;
  at_ = end;
  return {.offset = begin, .length = end - begin, .reason = reason};
}

void append_record(std::vector<std::byte>& recording, WallTime time, Bytes frame) {
  std::array<std::byte, stamp_size> stamp{};
  store_be(stamp.data(), unix_us(time));
  recording.insert(recording.end(), stamp.begin(), stamp.end());
  recording.insert(recording.end(), frame.begin(), frame.end());
}

}  // namespace ponte::mavlink
