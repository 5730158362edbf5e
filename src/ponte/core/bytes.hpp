#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

namespace ponte {

/// A borrowed run of bytes, valid only as long as the buffer it points into.
using Bytes = std::span<const std::byte>;
using MutableBytes = std::span<std::byte>;

static_assert(std::endian::native == std::endian::little, "byte order of the host is taken for granted below");

template <class T>
concept WireNumber = std::integral<T> || std::floating_point<T>;

namespace detail {
template <WireNumber T>
constexpr T reversed(T value) {
  auto bytes = std::bit_cast<std::array<std::byte, sizeof(T)>>(value);
  for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
  return std::bit_cast<T>(bytes);
}
}  // namespace detail

/// Reads a number of the type's own width at `at`, least significant byte first. The caller has checked the size.
template <WireNumber T>
[[nodiscard]] inline T load_le(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

template <WireNumber T>
inline void store_le(std::byte* at, T value) {
  std::memcpy(at, &value, sizeof value);
}

/// The same, most significant byte first.
template <WireNumber T>
[[nodiscard]] inline T load_be(const std::byte* at) {
  return detail::reversed(load_le<T>(at));
}

template <WireNumber T>
inline void store_be(std::byte* at, T value) {
  store_le(at, detail::reversed(value));
}

[[nodiscard]] inline std::uint8_t u8(Bytes bytes, std::size_t at) { return std::to_integer<std::uint8_t>(bytes[at]); }
[[nodiscard]] inline std::uint16_t u16_le(Bytes bytes, std::size_t at) { return load_le<std::uint16_t>(&bytes[at]); }
[[nodiscard]] inline std::uint16_t u16_be(Bytes bytes, std::size_t at) { return load_be<std::uint16_t>(&bytes[at]); }
[[nodiscard]] inline std::uint32_t u32_be(Bytes bytes, std::size_t at) { return load_be<std::uint32_t>(&bytes[at]); }
[[nodiscard]] inline std::uint64_t u64_be(Bytes bytes, std::size_t at) { return load_be<std::uint64_t>(&bytes[at]); }

/// The bytes of a text, for parsers that are fed from literals and files.
[[nodiscard]] inline Bytes bytes_of(std::span<const char> text) { return std::as_bytes(text); }

}  // namespace ponte
