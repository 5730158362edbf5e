#pragma once

#include <cstddef>
#include <cstdint>

namespace ponte::dli {

/// What follows the message data, as the two bits of the Message Properties say it. Sums are the plain additive sum of
/// every byte before them (Edition 3, checksum).
enum class Checksum : std::uint8_t {
  none = 0b00,
  sum16 = 0b01,
  sum32 = 0b10,
  unassigned = 0b11,  ///< in Edition 3; one Edition A implementation puts four bytes of a CRC of its own there
};

/// Bytes that follow the message data. Four for the unassigned code, its only witnessed use.
[[nodiscard]] constexpr std::size_t size_of(Checksum checksum) {
  switch (checksum) {
    case Checksum::none: return 0;
    case Checksum::sum16: return 2;
    case Checksum::sum32:
    case Checksum::unassigned: return 4;
  }
  return 0;
}

/// The Message Properties of the wrapper (Edition 3, Message Properties), without its six reserved bits.
struct Properties {
  bool acknowledgement_wanted{};
  std::uint8_t idd_version{};  ///< 7 bits: 30 in Edition 3, 32 in Edition A
  Checksum checksum{};

  friend constexpr bool operator==(const Properties&, const Properties&) = default;
};

/// Reserved bits are ignored.
[[nodiscard]] constexpr Properties properties_from_word(std::uint16_t word) {
  return {
      .acknowledgement_wanted = (word & 0x8000U) != 0,
      .idd_version = static_cast<std::uint8_t>(word >> 8U & 0x7FU),
      .checksum = static_cast<Checksum>(word >> 6U & 0b11U),
  };
}

/// Reserved bits are zero.
[[nodiscard]] constexpr std::uint16_t to_word(const Properties& properties) {
  return static_cast<std::uint16_t>((properties.acknowledgement_wanted ? 0x8000U : 0U) |
                                    (properties.idd_version & 0x7FU) << 8U |
                                    static_cast<unsigned>(properties.checksum) << 6U);
}

}  // namespace ponte::dli
