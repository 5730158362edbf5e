#include "ponte/sim/flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ponte::sim {
namespace {

using enum FlightMode;

struct ModeName {
  FlightMode mode;
  std::string_view name;
};

constexpr std::array modes{
    ModeName{stabilize, "STABILIZE"}, ModeName{automatic, "AUTO"}, ModeName{guided, "GUIDED"},
    ModeName{loiter, "LOITER"},       ModeName{rtl, "RTL"},        ModeName{land, "LAND"},
};

constexpr Metres highest_take_off{1000};  // above home
constexpr Metres return_height{15};       // above home, at least
constexpr MetresPerSecond return_speed{8};
constexpr double arrived_within = 1.0;      // m over ground
constexpr double home_within = 0.2;         // m over ground
constexpr double nearly_still = 0.1;        // m/s
constexpr double at_altitude_within = 0.3;  // m

constexpr std::uint32_t steps_of(Duration duration) {
  return static_cast<std::uint32_t>(duration / Copter::step_length);
}
constexpr auto square_begins_after = steps_of(std::chrono::seconds{2});
constexpr auto disarms_landed_after = steps_of(std::chrono::seconds{1});
constexpr auto disarms_idle_after = steps_of(std::chrono::seconds{10});

bool is_at(const Copter& copter, Metres altitude) {
  return std::abs(copter.state().position.altitude_msl.value - altitude.value) < at_altitude_within;
}

}  // namespace

std::optional<FlightMode> flight_mode(std::uint32_t custom_mode) {
  const auto found = std::find_if(modes.begin(), modes.end(), [=](const ModeName& each) {
    return custom_mode == std::uint32_t{static_cast<std::uint8_t>(each.mode)};
  });
  if (found == modes.end()) return std::nullopt;
  return found->mode;
}

std::string_view name_of(FlightMode mode) {
  return std::find_if(modes.begin(), modes.end(), [=](const ModeName& each) { return each.mode == mode; })->name;
}

bool Flight::enter(FlightMode mode, Copter& copter) {
  if (mode == mode_) return true;
  if (mode == automatic && copter.state().armed) return false;  // there is no mission to fly
  mode_ = mode;
  leg_ = Leg::none;
  if (!copter.state().airborne) {
    copter.hold();  // a take-off that has not begun yet
    return true;
  }
  if (mode == guided && flies_square_) {
    leg_ = Leg::square;
  } else if (mode == rtl) {
    leg_ = Leg::rise;
    return_altitude_ = std::max(copter.state().position.altitude_msl, home_.altitude_msl + return_height);
    copter.climb_to(return_altitude_);
  } else if (mode == land) {
    leg_ = Leg::descend;
    copter.land();
  } else {
    copter.hold();
  }
  return true;
}

void Flight::on_armed(Copter& copter) {
  leg_ = Leg::none;
  idle_steps_ = 0;
  corner_ = 0;
  height_ = square_.height;
  if (flies_square_) static_cast<void>(enter(guided, copter));
}

bool Flight::take_off(Metres height, Copter& copter) {
  const auto& state = copter.state();
  if (mode_ != guided || !state.armed || state.airborne) return false;
  if (height <= Metres{} || height > highest_take_off) return false;
  height_ = height;
  leg_ = Leg::take_off;
  copter.climb_to(home_.altitude_msl + height);
  return true;
}

void Flight::step(Copter& copter) {
  if (!copter.state().armed) {
    leg_ = Leg::none;
    return;
  }
  if (!copter.state().airborne && leg_ != Leg::take_off) {
    wait_on_ground(copter);
    return;
  }
  switch (leg_) {
    case Leg::take_off:
      if (is_at(copter, home_.altitude_msl + height_)) leg_ = flies_square_ ? Leg::square : Leg::none;
      return;
    case Leg::square: fly_square(copter); return;
    case Leg::rise: rise(copter); return;
    case Leg::cross: cross(copter); return;
    case Leg::none:
    case Leg::descend: return;
  }
}

void Flight::wait_on_ground(Copter& copter) {
  if (leg_ != Leg::none) {  // it has just landed
    leg_ = Leg::none;
    idle_steps_ = 0;
  }
  ++idle_steps_;
  if (mode_ == guided && flies_square_ && idle_steps_ >= square_begins_after) {
    static_cast<void>(take_off(height_, copter));
    return;
  }
  const bool has_landed = mode_ == land || mode_ == rtl;
  if (idle_steps_ >= (has_landed ? disarms_landed_after : disarms_idle_after)) copter.disarm();
}

void Flight::fly_square(Copter& copter) {
  constexpr std::array<NorthEastDown, 4> corners{{{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}}};
  auto corner = displaced(home_, corners[corner_] * square_.side.value);
  corner.altitude_msl = home_.altitude_msl + height_;
  copter.fly_to(corner, square_.speed);
  if (horizontal(offset_between(copter.state().position, corner)) < arrived_within)
    corner_ = static_cast<std::uint8_t>((corner_ + 1) % corners.size());
}

void Flight::rise(Copter& copter) {
  if (!is_at(copter, return_altitude_)) return;
  leg_ = Leg::cross;
  auto above_home = home_;
  above_home.altitude_msl = return_altitude_;
  copter.fly_to(above_home, return_speed);
}

void Flight::cross(Copter& copter) {
  const auto& state = copter.state();
  if (horizontal(offset_between(state.position, home_)) > home_within || horizontal(state.velocity) > nearly_still)
    return;
  leg_ = Leg::descend;
  copter.land();
}

LandedState Flight::landed_state(const CopterState& state) const {
  if (!state.airborne) return LandedState::on_ground;
  if (leg_ == Leg::take_off) return LandedState::taking_off;
  if (leg_ == Leg::descend) return LandedState::landing;
  return LandedState::in_air;
}

std::optional<Position> Flight::target(const Copter& copter) const {
  if (!copter.state().airborne || leg_ == Leg::descend || (mode_ != guided && mode_ != rtl)) return std::nullopt;
  return copter.target();
}

}  // namespace ponte::sim
