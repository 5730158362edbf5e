#pragma once

#include <cstdint>

/// Chance that is the same on every compiler and processor.
namespace ponte::sim {

/// 64 random bits, a function of the seed and the number of the draw alone (SplitMix64). So no draw depends on which
/// others were made, or in which order.
[[nodiscard]] constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t draw) {
  auto bits = seed + (draw + 1) * 0x9E37'79B9'7F4A'7C15;
  bits = (bits ^ (bits >> 30U)) * 0xBF58'476D'1CE4'E5B9;
  bits = (bits ^ (bits >> 27U)) * 0x94D0'49BB'1331'11EB;
  return bits ^ (bits >> 31U);
}

/// Nearly normal, of mean 0 and standard deviation 1, never beyond 3.5: the sum of four uniform numbers of 16 bits.
[[nodiscard]] constexpr double random_normal(std::uint64_t seed, std::uint64_t draw) {
  const auto bits = random_bits(seed, draw);
  const auto sum = (bits & 0xFFFFU) + ((bits >> 16U) & 0xFFFFU) + ((bits >> 32U) & 0xFFFFU) + (bits >> 48U);
  constexpr double mean = 2 * 65535.0;
  constexpr double deviation = 37837.22723720648;  // sqrt(4 * (65536^2 - 1) / 12)
  return (static_cast<double>(sum) - mean) / deviation;
}

}  // namespace ponte::sim
