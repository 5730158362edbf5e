#include "ponte/mavlink/crc.hpp"

#include <array>
#include <cstddef>

namespace ponte::mavlink {
namespace {

constexpr std::size_t stride = 16;
constexpr std::uint16_t polynomial = 0x8408;

using Tables = std::array<std::array<std::uint16_t, 256>, stride>;

// tables[n][b] is what byte b contributes to the checksum once n more bytes have followed it. As contributions only
// need to be combined by exclusive or, a whole stride is looked up at once, without one step waiting for the other.
constexpr Tables make_tables() {
  Tables tables{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ polynomial : crc >> 1U;
    tables[0][byte] = static_cast<std::uint16_t>(crc);
  }
  for (std::size_t n = 1; n < stride; ++n) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const unsigned before = tables[n - 1][byte];
      tables[n][byte] = static_cast<std::uint16_t>((before >> 8U) ^ tables[0][before & 0xFFU]);
    }
  }
  return tables;
}

constexpr Tables tables = make_tables();

/// The checksum after `size` more bytes, of which there are 2 to `stride`.
inline unsigned add_block(const std::byte* at, std::size_t size, unsigned crc) {
  const auto byte = [&](std::size_t i) { return std::to_integer<unsigned>(at[i]); };
  unsigned sum = tables[size - 1][byte(0) ^ (crc & 0xFFU)] ^ tables[size - 2][byte(1) ^ (crc >> 8U)];
  for (std::size_t i = 2; i < size; ++i) sum ^= tables[size - 1 - i][byte(i)];
  return sum;
}

}  // namespace

std::uint16_t detail::crc_by_tables(Bytes bytes, std::uint16_t before) {
  unsigned crc = before;
  const std::byte* at = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= stride; at += stride, left -= stride) crc = add_block(at, stride, crc);
  if (left >= 8) {
    crc = add_block(at, 8, crc);
    at += 8;
    left -= 8;
  }
  if (left >= 2) return static_cast<std::uint16_t>(add_block(at, left, crc));
  if (left == 1) return crc_of(std::to_integer<std::uint8_t>(*at), static_cast<std::uint16_t>(crc));
  return static_cast<std::uint16_t>(crc);
}

}  // namespace ponte::mavlink
