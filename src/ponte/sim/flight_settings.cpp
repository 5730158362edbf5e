#include "ponte/sim/flight_settings.hpp"

namespace ponte::sim {
namespace {

using std::chrono::seconds;

constexpr FlightSettings ardu_copter{
    .cruise_speed = MetresPerSecond{10},
    .acceptance_radius = Metres{2},
    .loiter_radius = Metres{10},
    .take_off_height = Metres{10},
    .mode_takes_off = false,
    .return_height = Metres{15},
    .return_cone_slope = 3,
    .return_speed = MetresPerSecond{10},
    .return_wait = seconds{5},
    .guided_time_out = seconds{3},
    .disarms_idle_after = seconds{10},
    .disarms_landed_after = seconds{1},
};

constexpr FlightSettings ardu_plane{
    .cruise_speed = MetresPerSecond{22},
    .acceptance_radius = Metres{50},
    .loiter_radius = Metres{60},
    .take_off_height = Metres{50},
    .mode_takes_off = true,
    .return_height = Metres{100},
    .return_cone_slope = 0,
    .return_speed = MetresPerSecond{22},
    .return_wait = {},
    .guided_time_out = {},
    .disarms_idle_after = {},
    .disarms_landed_after = seconds{20},
};

constexpr FlightSettings px4_copter{
    .cruise_speed = MetresPerSecond{5},
    .acceptance_radius = Metres{2},
    .loiter_radius = Metres{80},
    .take_off_height = Metres{2.5},
    .mode_takes_off = true,
    .return_height = Metres{30},
    .return_cone_slope = 1,
    .return_speed = MetresPerSecond{5},
    .return_wait = {},
    .guided_time_out = seconds{1},
    .disarms_idle_after = seconds{10},
    .disarms_landed_after = seconds{2},
};

constexpr FlightSettings px4_plane{
    .cruise_speed = MetresPerSecond{15},
    .acceptance_radius = Metres{10},
    .loiter_radius = Metres{80},
    .take_off_height = Metres{30},
    .mode_takes_off = true,
    .return_height = Metres{60},
    .return_cone_slope = 0,
    .return_speed = MetresPerSecond{15},
    .return_wait = {},
    .guided_time_out = seconds{1},
    .disarms_idle_after = seconds{10},
    .disarms_landed_after = seconds{2},
};

}  // namespace

FlightSettings default_flight_settings(VehicleKind kind) {
  const bool is_plane = kind.type == AirframeType::plane;
  if (kind.personality == Personality::px4) return is_plane ? px4_plane : px4_copter;
  return is_plane ? ardu_plane : ardu_copter;
}

}  // namespace ponte::sim
