#pragma once

#include "ponte/sim/airframe.hpp"
#include "ponte/sim/personality.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace ponte::sim {

/// Which vehicle it is to those who talk to it.
struct VehicleKind {
  Personality personality{};
  AirframeType type{};
  friend bool operator==(const VehicleKind&, const VehicleKind&) = default;
};

/// The modes that are flown here, by what they do. Each autopilot has its own choice, numbers and names of them.
enum class FlightMode : std::uint8_t {
  manual,
  stabilize,
  altitude_hold,
  position_hold,
  loiter,
  circle,
  brake,
  guided,  ///< OFFBOARD of PX4
  automatic,
  take_off,
  rtl,
  land,
};

struct FlightModeInfo {
  FlightMode mode{};
  std::uint32_t custom_mode{};  ///< of HEARTBEAT
  std::string_view name;        ///< as the autopilot calls it: "RTL"
  bool needs_position{};
  bool armable{};  ///< may be armed in this mode
};

/// All modes of this kind of vehicle.
[[nodiscard]] std::span<const FlightModeInfo> flight_modes(VehicleKind kind);
/// One that this kind has: another is a mistake of the caller's.
[[nodiscard]] const FlightModeInfo& flight_mode_info(VehicleKind kind, FlightMode mode);
/// What this kind has under the number, or nothing.
[[nodiscard]] std::optional<FlightMode> flight_mode(VehicleKind kind, std::uint32_t custom_mode);
/// Whether this kind has the mode.
[[nodiscard]] bool has_mode(VehicleKind kind, FlightMode mode);

}  // namespace ponte::sim
