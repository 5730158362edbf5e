#pragma once

#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/sim/airframe.hpp"
#include "ponte/sim/copter.hpp"
#include "ponte/sim/faults.hpp"
#include "ponte/sim/personality.hpp"
#include "ponte/sim/plane.hpp"
#include "ponte/sim/wind.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ponte::sim {

/// The square that the vehicle flies all by itself, with its first corner at home and the second one north of it.
struct SquareConfig {
  Metres side{60};
  Metres height{20};  ///< above home
  MetresPerSecond speed{5};
};

/// A parameter of the autopilot that does not begin with its default.
struct ParameterSetting {
  std::string name;
  double value{};
};

/// After the start of the autopilot, each later than the one before. Arming is refused until there is a position.
struct StartTimes {
  Duration ready;
  Duration fix;
  Duration position;
};

/// As they were recorded; but for ArduPilot's position, which nobody has to wait 40 seconds for.
constexpr StartTimes start_times(Personality personality) {
  using std::chrono::milliseconds;
  if (personality == Personality::px4) return {milliseconds{1000}, milliseconds{1000}, milliseconds{3500}};
  return {milliseconds{2500}, milliseconds{5000}, milliseconds{8000}};
}

/// One simulated vehicle. Everything that it does follows from this and from what it receives.
struct VehicleConfig {
  Personality personality{Personality::ardupilot};
  mavlink::SystemId system{1};
  mavlink::ComponentId component{1};
  mavlink::Version version{mavlink::Version::v2};  ///< of what it sends; with 1 and 2 it understands both

  Position start{radians_from_degrees(-30.06898), radians_from_degrees(-51.12179), Metres{50}};
  Radians heading{};
  WallTime power_on{std::chrono::sys_days{std::chrono::year{2026} / 1 / 1} + std::chrono::hours{12}};  ///< UTC

  AirframeType type{AirframeType::copter};
  CopterConfig copter{};
  PlaneConfig plane{};
  WindConfig wind{};
  std::vector<Fault> faults{};
  bool fly_square{true};  ///< in GUIDED, once it is armed; otherwise it waits for NAV_TAKEOFF, and holds
  SquareConfig square{};

  std::vector<ParameterSetting> parameters{};  ///< that this autopilot has
  bool radio{};                                ///< a telemetry radio is on its line
  std::optional<std::size_t> line_rate{};      ///< bytes per second that its line carries; nothing: as many as it likes
  std::optional<std::size_t> mission_items{};  ///< the most of a mission; nothing: as many as the real autopilot takes

  std::uint64_t seed{1};  ///< of the sensors' noise, the gusts, and what is believed without satellites
  double noise{1};        ///< of the sensors: 0 none, 1 what good ones have
};

}  // namespace ponte::sim
