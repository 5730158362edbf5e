#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/dli/wrapper.hpp"

#include <array>
#include <cstdint>
#include <optional>

/// One UDP payload: messages back to back, none of them split, 548 bytes at most (Edition 3, transport).
namespace ponte::dli {

struct DatagramError {
  WrapperError reason;
  std::size_t offset;  ///< of the message that is not good, in the payload

  friend constexpr bool operator==(const DatagramError&, const DatagramError&) = default;
};

/// What a receiver has seen since it began.
struct DatagramCounters {
  std::uint64_t datagrams{};
  std::uint64_t messages{};       ///< good ones
  std::uint64_t too_long{};       ///< datagrams of more than 548 bytes; they are read all the same
  std::uint64_t other_version{};  ///< good messages whose IDD version is not the profile's
  std::uint64_t unexamined{};     ///< good messages with the unassigned checksum code
  /// Datagrams whose size tells another checksum length than the Message Properties of their only message. The
  /// properties decide what is done with the message.
  std::uint64_t checksum_length_mismatch{};
  std::array<std::uint64_t, wrapper_error_count> errors{};  ///< by `WrapperError`

  [[nodiscard]] std::uint64_t count_of(WrapperError reason) const { return errors[static_cast<std::size_t>(reason)]; }
  friend bool operator==(const DatagramCounters&, const DatagramCounters&) = default;
};

/// Takes the messages of one payload apart, and counts what it finds. A message with a bad checksum, or with a checksum
/// of unassigned kind, is stepped over by its length; after any other error nothing can be found any more.
class DatagramReader {
 public:
  /// `payload`, `profile` and `counters` must outlive the reader; what it returns points into `payload`.
  DatagramReader(Bytes payload, const Profile& profile, DatagramCounters& counters);

  /// The next message or error in the order of the bytes; nothing after the last.
  [[nodiscard]] std::optional<Result<WrapperView, DatagramError>> next();

 private:
  void compare_checksum_length();

  Bytes payload_;
  const Profile* profile_;
  DatagramCounters* counters_;
  std::size_t offset_{};
  bool at_end_{};
};

/// Packs messages into a datagram, in a buffer of the caller's. When a message does not fit any more, send what `bytes`
/// has, call `clear`, and add the message again.
class DatagramWriter {
 public:
  /// Of `buffer` at most 548 bytes are used. `buffer` and `profile` must outlive the writer.
  DatagramWriter(MutableBytes buffer, const Profile& profile);

  /// Adds one message and returns its bytes, wrapper to checksum. Fails with `no_room` when it has to go into the next
  /// datagram, and with `too_long` when it would not fit into an empty one either. A failure changes nothing.
  [[nodiscard]] Result<Bytes, WriteError> add(const Envelope& envelope, MessageNumber number, Bytes data);

  /// Where the data of the next message may be written in place; `add_in_place` then adds the first `data_size` bytes.
  [[nodiscard]] MutableBytes room() const;
  [[nodiscard]] Result<Bytes, WriteError> add_in_place(const Envelope& envelope, MessageNumber number,
                                                       std::size_t data_size);

  [[nodiscard]] const Profile& profile() const { return *profile_; }
  [[nodiscard]] Bytes bytes() const { return buffer_.first(size_); }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  void clear() { size_ = 0; }

 private:
  [[nodiscard]] Result<Bytes, WriteError> keep(Result<std::size_t, WriteError> written);

  MutableBytes buffer_;
  const Profile* profile_;
  std::size_t size_{};
};

}  // namespace ponte::dli
