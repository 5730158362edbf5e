#include "ponte/mavlink/ftp_message.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>

namespace ponte::mavlink {

Bytes FtpMessage::bytes() const { return Bytes{data}.first(std::min<std::size_t>(size, data_size_max)); }

std::string_view FtpMessage::path() const {
  const auto text = bytes();
  const auto end = std::find(text.begin(), text.end(), std::byte{0});
  return {reinterpret_cast<const char*>(text.data()), static_cast<std::size_t>(end - text.begin())};
}

void FtpMessage::set_bytes(Bytes bytes) {
  PONTE_ASSERT(bytes.size() <= data_size_max);
  size = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), data.begin());
}

FtpMessage read_ftp(const FtpPayload& from) {
  const auto payload = std::as_bytes(std::span{from});
  FtpMessage result{
      .sequence = u16_le(payload, 0),
      .session = u8(payload, 2),
      .opcode = static_cast<FtpOpcode>(u8(payload, 3)),
      .size = u8(payload, 4),
      .request = static_cast<FtpOpcode>(u8(payload, 5)),
      .burst_complete = u8(payload, 6) != 0,
      .offset = load_le<std::uint32_t>(&payload[8]),
  };
  std::copy(payload.begin() + FtpMessage::header_size, payload.end(), result.data.begin());
  return result;
}

FtpPayload write_ftp(const FtpMessage& content) {
  FtpPayload result{};
  const auto payload = std::as_writable_bytes(std::span{result});
  store_le(payload.data(), content.sequence);
  payload[2] = std::byte{content.session};
  payload[3] = static_cast<std::byte>(content.opcode);
  payload[4] = std::byte{content.size};
  payload[5] = static_cast<std::byte>(content.request);
  payload[6] = content.burst_complete ? std::byte{1} : std::byte{0};
  payload[7] = std::byte{0};
  store_le(&payload[8], content.offset);
  std::copy(content.data.begin(), content.data.end(), payload.begin() + FtpMessage::header_size);
  return result;
}

}  // namespace ponte::mavlink
