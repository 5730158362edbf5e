#pragma once

#include "ponte/vehicle/vocabulary.hpp"

#include <cstdint>
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

/// A number that no table has is a mode of kind `other` named "mode N".
[[nodiscard]] vehicle::Mode mode_from(Stack stack, std::uint32_t custom_mode);

}  // namespace ponte::autopilot
