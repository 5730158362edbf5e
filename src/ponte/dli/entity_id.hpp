#pragma once

#include "ponte/core/result.hpp"
#include "ponte/core/text.hpp"

#include <compare>
#include <cstdint>
#include <string_view>

namespace ponte::dli {

/// Three bits of an entity id. `cucs` and `vsm` are witnessed in Edition 3, the others are inferred, so an id is never
/// refused because of these bits; values without a name are legal.
enum class EntityType : std::uint8_t { unspecified = 0, cucs = 1, vehicle = 2, vsm = 3, data_link = 4 };

/// "CUCS", "vehicle" and so on; "unassigned" for a value without a name.
[[nodiscard]] std::string_view name_of(EntityType type);

/// Who sends or receives a message (Edition 3, identifiers): an owning code of 8 bits, the type of entity in 3 bits and
/// a national number of 21 bits.
struct EntityId {
  std::uint32_t value{};

  constexpr EntityId() = default;
  constexpr explicit EntityId(std::uint32_t number) : value{number} {}
  /// Of `national` only the low 21 bits count.
  constexpr EntityId(std::uint8_t owning_code, EntityType type, std::uint32_t national)
      : value{std::uint32_t{owning_code} << 24U | static_cast<std::uint32_t>(type) << 21U |
              (national & national_mask)} {}

  /// The country or organisation, e.g. 20 for Portugal. 255 is reserved.
  [[nodiscard]] constexpr std::uint8_t owning_code() const { return static_cast<std::uint8_t>(value >> 24U); }
  [[nodiscard]] constexpr EntityType type() const { return static_cast<EntityType>(value >> 21U & 0b111U); }
  [[nodiscard]] constexpr std::uint32_t national() const { return value & national_mask; }

  friend constexpr auto operator<=>(const EntityId&, const EntityId&) = default;

  static constexpr std::uint32_t national_mask = (std::uint32_t{1} << 21U) - 1U;
};

inline constexpr EntityId broadcast_id{0xFFFFFFFFU};
inline constexpr EntityId null_id{0xFF000000U};
inline constexpr EntityId not_applicable_id{0x00000000U};

/// Four pairs of upper-case hex digits with colons between them, as in "14:60:00:02".
[[nodiscard]] Text<11> to_text(EntityId id);

enum class EntityIdError : std::uint8_t { not_four_bytes, not_a_hex_digit };

/// Reads what `to_text` writes; lower-case digits are accepted.
[[nodiscard]] Result<EntityId, EntityIdError> parse_entity_id(std::string_view text);

}  // namespace ponte::dli
