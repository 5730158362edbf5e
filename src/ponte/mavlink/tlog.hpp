#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

/// Recordings of MAVLink: each record is a time stamp (microseconds since 1970, 64 bits, most significant byte first)
/// and one frame as it was on the wire.
namespace ponte::mavlink {

/// One record of a recording.
struct TlogRecord {
  std::size_t offset{};  ///< of the time stamp, from the beginning of the file
  WallTime time{};
  FrameView frame{};
  const MessageInfo* message{};  ///< nothing: not in the dialect
};

enum class TlogDamageReason {
  truncated,  ///< the file ends within the record
  checksum,   ///< the record has the shape of one, but its checksum is wrong
  no_frame,   ///< no whole frame where one was expected
};

/// A part of a recording that holds no intact record.
struct TlogDamage {
  std::size_t offset{};
  std::size_t length{};
  TlogDamageReason reason{};

  friend bool operator==(const TlogDamage&, const TlogDamage&) = default;
};

/// Reads a recording that is in memory. Records and damages follow each other without a gap, from the first byte to
/// the last.
///
/// Behind damage it goes on at the first place where an intact record begins. As a broken time stamp must not shift a
/// record, the time found there has to be within a day of a neighbour's: that of the record before, or of any intact
/// record in the 4096 bytes behind. In an undamaged row, times may be anything and go anywhere.
///
/// A record of an unknown message is intact if the file ends with it, or if the next record has the shape of one.
class TlogReader {
 public:
  /// Both must outlive the reader; the views in the records point into `file`.
  TlogReader(Bytes file, const Dialect& dialect) : file_{file}, dialect_{&dialect} {}

  /// The next part of the file; nothing at its end.
  [[nodiscard]] std::optional<std::variant<TlogRecord, TlogDamage>> next();

 private:
  std::optional<TlogRecord> record_shape_at(std::size_t offset) const;
  bool is_good(const TlogRecord& record) const;
  bool is_followed_well(const TlogRecord& record) const;
  bool has_close_neighbour(const TlogRecord& record) const;
  bool is_intact(const TlogRecord& record) const;
  std::optional<std::size_t> find_record(std::size_t first, std::size_t last) const;
  TlogDamage damage(std::size_t end, TlogDamageReason reason);

  Bytes file_;
  const Dialect* dialect_;
  std::size_t at_{};
  std::optional<WallTime> last_time_;
};

/// Appends one record to a recording.
void append_record(std::vector<std::byte>& recording, WallTime time, Bytes frame);

}  // namespace ponte::mavlink
