#pragma once

#include "ponte/core/bytes.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// What is inside a FILE_TRANSFER_PROTOCOL message (MAVFTP).
namespace ponte::mavlink {

/// The requests that Ponte makes or answers, and the two kinds of answers.
enum class FtpOpcode : std::uint8_t {
  none = 0,
  terminate_session = 1,
  reset_sessions = 2,
  list_directory = 3,
  open_read_only = 4,
  read_file = 5,
  create_file = 6,
  write_file = 7,
  remove_file = 8,
  open_write_only = 11,
  calculate_crc32 = 14,
  burst_read_file = 15,
  ack = 128,
  nak = 129,
};

/// Why a request was refused; the first byte of a NAK's data.
enum class FtpError : std::uint8_t {
  fail = 1,
  fail_errno = 2,
  bad_size = 3,
  bad_session = 4,
  no_session_free = 5,
  end_of_file = 6,
  unknown_command = 7,
  file_exists = 8,
  protected_file = 9,
  not_found = 10,
};

struct FtpMessage {
  static constexpr std::size_t header_size = 12;
  static constexpr std::size_t data_size_max = 239;

  std::uint16_t sequence{};
  std::uint8_t session{};
  FtpOpcode opcode{};
  std::uint8_t size{};  ///< of the data; for reading, how much is wanted
  FtpOpcode request{};  ///< in an answer: what it answers
  bool burst_complete{};
  std::uint32_t offset{};
  std::array<std::byte, data_size_max> data{};

  /// The data as it counts: never more than there is room for, whatever `size` says.
  [[nodiscard]] Bytes bytes() const;
  /// The data as a path: up to the first NUL.
  [[nodiscard]] std::string_view path() const;
  /// Takes so many bytes as its data, at most `data_size_max`.
  void set_bytes(Bytes bytes);
};

/// The payload field of FILE_TRANSFER_PROTOCOL.
using FtpPayload = std::array<std::uint8_t, FtpMessage::header_size + FtpMessage::data_size_max>;

[[nodiscard]] FtpMessage read_ftp(const FtpPayload& payload);
[[nodiscard]] FtpPayload write_ftp(const FtpMessage& content);

}  // namespace ponte::mavlink
