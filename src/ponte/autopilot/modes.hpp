#pragma once

#include "ponte/vehicle/vocabulary.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// What HEARTBEAT.custom_mode means, per autopilot: tables that can be read aloud, and a function that looks things up.
namespace ponte::autopilot {

/// Which of the mode tables applies.
enum class Stack : std::uint8_t { ardupilot_copter, ardupilot_plane, px4, unknown };

/// From HEARTBEAT.autopilot (MAV_AUTOPILOT) and HEARTBEAT.type (MAV_TYPE).
[[nodiscard]] Stack stack_of(std::uint8_t autopilot, std::uint8_t airframe);

/// One mode of a stack. `variant` of a mode of kind `other` is its number in ArduPilot; main mode, or 32 + sub mode of
/// AUTO, in PX4.
struct ModeRow {
  std::uint32_t custom_mode;
  std::string_view name;
  vehicle::ModeKind kind;
};

/// The modes of a stack, by custom_mode ascending; empty for `unknown`.
[[nodiscard]] std::span<const ModeRow> modes_of(Stack stack);

/// What a stack has for a kind of mode, and does without a pilot where it has several; nothing if it has none, or for
/// `none` and `other`. A plane of ArduPilot lands in AUTOLAND, which it has since 4.7.
[[nodiscard]] std::optional<std::uint32_t> custom_mode_for(Stack stack, vehicle::ModeKind kind);
/// The mode with this name, e.g. "RTL"; nothing if there is none.
[[nodiscard]] std::optional<std::uint32_t> custom_mode_named(Stack stack, std::string_view name);

/// A number that no table has is a mode of kind `other` named "mode N".
[[nodiscard]] vehicle::Mode mode_from(Stack stack, std::uint32_t custom_mode);

}  // namespace ponte::autopilot
