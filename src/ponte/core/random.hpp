#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>

namespace ponte {

/// Random numbers that are the same on every compiler and processor: SplitMix64, whose n-th number is a function of the
/// seed and n alone.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed) : seed_{seed} {}

  /// 64 random bits.
  [[nodiscard]] constexpr std::uint64_t next() {
    auto bits = seed_ + ++count_ * 0x9E37'79B9'7F4A'7C15;
    bits = (bits ^ (bits >> 30U)) * 0xBF58'476D'1CE4'E5B9;
    bits = (bits ^ (bits >> 27U)) * 0x94D0'49BB'1331'11EB;
    return bits ^ (bits >> 31U);
  }

  /// From 0 to before `bound`, which is not 0. Its bias is below 2^-32.
  [[nodiscard]] constexpr std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>(((next() >> 32U) * bound) >> 32U);
  }

  [[nodiscard]] constexpr std::byte byte() { return static_cast<std::byte>(next() >> 56U); }

  /// From 0 to before 1.
  [[nodiscard]] constexpr double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }

  [[nodiscard]] constexpr bool chance(double probability) { return unit() < probability; }

  /// From 0, of mean 1.04: the exponential distribution, its curve drawn as straight lines between the powers of 2. It
  /// needs no logarithm, whose last bit differs between libraries.
  [[nodiscard]] constexpr double exponential() {
    const auto bits = next();
    const auto halvings = std::countl_zero(bits | 1U);
    const auto rest = static_cast<double>((bits << static_cast<unsigned>(halvings)) << 1U) * 0x1p-64;
    return std::numbers::ln2 * (halvings + 1 - rest);
  }

  constexpr void fill(std::span<std::byte> bytes) {
    for (auto& each : bytes) each = byte();
  }

 private:
  std::uint64_t seed_;
  std::uint64_t count_{};
};

}  // namespace ponte
