#include "ponte/sim/flight_mode.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>
#include <array>

namespace ponte::sim {
namespace {

using enum FlightMode;

constexpr bool with_position = true;
constexpr bool may_arm = true;

constexpr std::array copter_modes{
    FlightModeInfo{stabilize, 0, "STABILIZE", false, may_arm},
    FlightModeInfo{altitude_hold, 2, "ALT_HOLD", false, may_arm},
    FlightModeInfo{automatic, 3, "AUTO", with_position, false},
    FlightModeInfo{guided, 4, "GUIDED", with_position, may_arm},
    FlightModeInfo{loiter, 5, "LOITER", with_position, may_arm},
    FlightModeInfo{rtl, 6, "RTL", with_position, false},
    FlightModeInfo{circle, 7, "CIRCLE", with_position, false},
    FlightModeInfo{land, 9, "LAND", false, false},
    FlightModeInfo{position_hold, 16, "POSHOLD", with_position, may_arm},
    FlightModeInfo{brake, 17, "BRAKE", with_position, false},
};

constexpr std::array plane_modes{
    FlightModeInfo{manual, 0, "MANUAL", false, may_arm},
    FlightModeInfo{circle, 1, "CIRCLE", false, may_arm},
    FlightModeInfo{stabilize, 2, "STABILIZE", false, may_arm},
    FlightModeInfo{altitude_hold, 6, "FBWB", false, may_arm},
    FlightModeInfo{automatic, 10, "AUTO", with_position, may_arm},
    FlightModeInfo{rtl, 11, "RTL", with_position, false},
    FlightModeInfo{loiter, 12, "LOITER", with_position, may_arm},
    FlightModeInfo{take_off, 13, "TAKEOFF", with_position, may_arm},
    FlightModeInfo{guided, 15, "GUIDED", with_position, may_arm},
};

/// PX4's custom_mode: the main mode in bits 16 to 23, the sub mode in bits 24 to 31.
constexpr std::uint32_t px4_mode(std::uint32_t main, std::uint32_t sub = 0) { return main << 16U | sub << 24U; }

constexpr std::uint32_t px4_auto = 4;

constexpr std::array px4_modes{
    FlightModeInfo{manual, px4_mode(1), "MANUAL", false, may_arm},
    FlightModeInfo{altitude_hold, px4_mode(2), "ALTCTL", false, may_arm},
    FlightModeInfo{position_hold, px4_mode(3), "POSCTL", with_position, may_arm},
    FlightModeInfo{circle, px4_mode(3, 1), "POSCTL.ORBIT", with_position, false},
    FlightModeInfo{take_off, px4_mode(px4_auto, 2), "AUTO.TAKEOFF", with_position, may_arm},
    FlightModeInfo{loiter, px4_mode(px4_auto, 3), "AUTO.LOITER", with_position, may_arm},
    FlightModeInfo{automatic, px4_mode(px4_auto, 4), "AUTO.MISSION", with_position, may_arm},
    FlightModeInfo{rtl, px4_mode(px4_auto, 5), "AUTO.RTL", with_position, false},
    FlightModeInfo{land, px4_mode(px4_auto, 6), "AUTO.LAND", false, false},
    FlightModeInfo{guided, px4_mode(6), "OFFBOARD", false, may_arm},
    FlightModeInfo{stabilize, px4_mode(7), "STABILIZED", false, may_arm},
};

}  // namespace

std::span<const FlightModeInfo> flight_modes(VehicleKind kind) {
  if (kind.personality == Personality::px4) return px4_modes;
  if (kind.type == AirframeType::plane) return plane_modes;
  return copter_modes;
}

const FlightModeInfo& flight_mode_info(VehicleKind kind, FlightMode mode) {
  const auto modes = flight_modes(kind);
  const auto found = std::ranges::find(modes, mode, &FlightModeInfo::mode);
  PONTE_ASSERT(found != modes.end());
  return *found;
}

std::optional<FlightMode> flight_mode(VehicleKind kind, std::uint32_t custom_mode) {
  const auto modes = flight_modes(kind);
  const auto found = std::ranges::find(modes, custom_mode, &FlightModeInfo::custom_mode);
  if (found == modes.end()) return std::nullopt;
  return found->mode;
}

bool has_mode(VehicleKind kind, FlightMode mode) {
  const auto modes = flight_modes(kind);
  return std::ranges::find(modes, mode, &FlightModeInfo::mode) != modes.end();
}

}  // namespace ponte::sim
