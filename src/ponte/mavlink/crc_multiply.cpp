#include "ponte/mavlink/crc.hpp"

#ifdef __x86_64__

#include <immintrin.h>

#include <array>

#define PONTE_WITH_MULTIPLICATION __attribute__((target("pclmul,sse4.1")))

namespace ponte::mavlink::detail {
namespace {

// Bytes are polynomials over GF(2), lowest bit first, and the checksum is their remainder by the generator. Each word
// of 8 bytes contributes word * x^(bits behind it), so all words can be multiplied by known powers at the same time,
// and the sum of the products, of less than 80 bits, be divided once.

constexpr unsigned polynomial = 0x8408;
constexpr std::size_t block_size = 16;
constexpr std::size_t most_blocks = 18;  // of the longest frame, and some

constexpr unsigned times_x8(unsigned remainder) {
  for (int bit = 0; bit < 8; ++bit)
    remainder = (remainder & 1U) != 0 ? (remainder >> 1U) ^ polynomial : remainder >> 1U;
  return remainder;
}

using Powers = std::array<std::array<std::uint64_t, 2>, most_blocks>;

/// Of the two words of each block, with this many blocks behind it.
constexpr Powers make_powers() {
  Powers powers{};
  unsigned power = 0x8000;  // 1
  for (auto& block : powers) {
    for (const std::size_t word : {1U, 0U}) {
      block[word] = power;
      for (int byte = 0; byte < 8; ++byte) power = times_x8(power);
    }
  }
  return powers;
}

/// Byte n of the table's row m is what byte n contributes with m more bytes behind it.
using Tables = std::array<std::array<std::uint16_t, 256>, 10>;

constexpr Tables make_tables() {
  Tables tables{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    unsigned remainder = byte;
    for (auto& row : tables) {
      remainder = times_x8(remainder);
      row[byte] = static_cast<std::uint16_t>(remainder);
    }
  }
  return tables;
}

alignas(64) constexpr Powers powers = make_powers();
alignas(64) constexpr Tables tables = make_tables();

PONTE_WITH_MULTIPLICATION inline __m128i load(const std::byte* at) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
}

PONTE_WITH_MULTIPLICATION inline __m128i multiply(__m128i block, std::size_t blocks_behind) {
  const auto power = _mm_load_si128(reinterpret_cast<const __m128i*>(powers[blocks_behind].data()));
  return _mm_xor_si128(_mm_clmulepi64_si128(block, power, 0x00), _mm_clmulepi64_si128(block, power, 0x11));
}

/// The first `size` of the 16 bytes at `at`, changed by `before`, at the end of a block of zeros.
PONTE_WITH_MULTIPLICATION inline __m128i load_first(const std::byte* at, __m128i before, std::size_t size) {
  alignas(16) static constexpr std::array<std::uint8_t, 32> shuffles{
      0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80,
      0,    1,    2,    3,    4,    5,    6,    7,    8,    9,    10,   11,   12,   13,   14,   15};
  const auto shuffle = _mm_loadu_si128(reinterpret_cast<const __m128i*>(&shuffles[size]));
  return _mm_shuffle_epi8(_mm_xor_si128(load(at), before), shuffle);
}

}  // namespace

const bool multiplies = __builtin_cpu_supports("pclmul") != 0 && __builtin_cpu_supports("sse4.1") != 0;

PONTE_WITH_MULTIPLICATION std::uint16_t crc_by_multiplication(Bytes bytes, std::uint16_t before) {
  constexpr std::size_t longest = most_blocks * block_size;
  for (; bytes.size() > longest; bytes = bytes.subspan(longest))
    before = crc_by_multiplication(bytes.first(longest), before);
  if (bytes.size() < least_multiplied) return crc_by_tables(bytes, before);

  // What was before belongs to the first two bytes; the first block may end between them.
  const auto first_size = (bytes.size() - 1) % block_size + 1;
  auto blocks = (bytes.size() - first_size) / block_size;
  const std::byte* at = bytes.data();
  const auto first = load_first(at, _mm_cvtsi32_si128(before), first_size);
  auto sum = multiply(first, blocks);
  at += first_size;
  if (blocks > 0) {
    const auto carried = _mm_cvtsi32_si128(first_size == 1 ? before >> 8U : 0);
    sum = _mm_xor_si128(sum, multiply(_mm_xor_si128(load(at), carried), --blocks));
    at += block_size;
  }
  for (; blocks > 0; at += block_size) sum = _mm_xor_si128(sum, multiply(load(at), --blocks));

  // A product of 64 and 16 bits has its lowest bit one place too low for a whole number of bytes.
  const auto low = static_cast<std::uint64_t>(_mm_cvtsi128_si64(sum));
  const auto high = static_cast<std::uint64_t>(_mm_extract_epi64(sum, 1)) << 1U | low >> 63U;
  const auto part = [](std::uint64_t word, unsigned place, std::size_t behind) {
    return tables[behind][word >> place & 0xFFU];
  };
  const auto word = low << 1U;
  const unsigned a = part(word, 0, 9) ^ part(word, 8, 8) ^ part(word, 16, 7) ^ part(word, 24, 6);
  const unsigned b = part(word, 32, 5) ^ part(word, 40, 4) ^ part(word, 48, 3) ^ part(word, 56, 2);
  return static_cast<std::uint16_t>(a ^ b ^ part(high, 0, 1) ^ part(high, 8, 0));
}

}  // namespace ponte::mavlink::detail

#else

namespace ponte::mavlink::detail {

const bool multiplies = false;

std::uint16_t crc_by_multiplication(Bytes bytes, std::uint16_t before) { return crc_by_tables(bytes, before); }

}  // namespace ponte::mavlink::detail

#endif
