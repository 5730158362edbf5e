#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/sim/autopilot.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

/// The place that a command names, or nothing if it names none.
std::optional<Position> place_of(const Command& command, Metres altitude) {
  if (!(std::abs(command.x) <= 90) || !(std::abs(command.y) <= 180) || (command.x == 0 && command.y == 0))
    return std::nullopt;
  return Position{radians_from_degrees(command.x), radians_from_degrees(command.y), altitude};
}

}  // namespace

/// To ArduPilot parameter 7 is a height above home; to PX4 an altitude, and without one it has a height of its own.
std::uint8_t Autopilot::take_off(const Command& command, Call& call) {
  auto height = Metres{command.z};
  if (is_px4()) {
    height = std::isnan(command.z) ? flight_.settings().take_off_height : height - flight_.home().altitude_msl;
  } else if (!std::isfinite(command.z) ||
             (command.frame && *command.frame != messages::MAV_FRAME_GLOBAL_RELATIVE_ALT)) {
    return messages::MAV_RESULT_DENIED;
  }
  const bool done = flight_.take_off(height, snapshot_.since_boot, call.airframe, facts_);
  tell_facts(call.speaker);
  return done ? std::uint8_t{messages::MAV_RESULT_ACCEPTED} : not_now();
}

/// PX4 has the main mode in parameter 2 and the sub mode in parameter 3.
std::uint8_t Autopilot::do_set_mode(const Command& command, Call& call) {
  auto number = whole_number(command.param2, 255);
  if (is_px4() && number) {
    const auto sub = whole_number(command.param3, 255);
    number = sub ? std::optional{*number << 16U | *sub << 24U} : std::nullopt;
  }
  return set_mode(command.param1, number, call);
}

std::uint8_t Autopilot::set_mode(float base_mode, std::optional<std::uint32_t> custom_mode, Call& call) {
  const auto flags = whole_number(base_mode, 255);
  if (!flags || (*flags & messages::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED) == 0) return messages::MAV_RESULT_DENIED;
  const auto mode = custom_mode ? flight_mode(flight_.kind(), *custom_mode) : std::nullopt;
  if (mode) return enter(*mode, call);
  std::array<char, 50> text{};
  const auto size = fmt::format_to_n(text.data(), text.size(), "No such mode {}", custom_mode.value_or(0)).size;
  call.speaker.say(messages::MAV_SEVERITY_WARNING, {text.data(), std::min(size, text.size())});
  return not_now();
}

std::uint8_t Autopilot::enter(FlightMode mode, Call& call) {
  const bool done = flight_.enter(mode, snapshot_.since_boot, call.airframe, facts_);
  tell_facts(call.speaker);
  if (done) return messages::MAV_RESULT_ACCEPTED;
  const auto name = has_mode(flight_.kind(), mode) ? flight_mode_info(flight_.kind(), mode).name : "it";
  std::array<char, 80> text{};
  const auto* form =
      is_px4() ? "Switching to mode '{}' is currently not possible\t" : "Mode change to {} failed: init failed";
  const auto size = fmt::format_to_n(text.data(), text.size(), fmt::runtime(form), name).size;
  call.speaker.say(is_px4() ? messages::MAV_SEVERITY_CRITICAL : messages::MAV_SEVERITY_WARNING,
                   {text.data(), std::min(size, text.size())});
  return not_now();
}

/// What PX4 is not told of the place (NaN) is as it is now.
std::optional<Position> Autopilot::place_or_here(const Command& command) const {
  const auto here = snapshot_.readings.position;
  const auto frame = command.frame.value_or(messages::MAV_FRAME_GLOBAL);
  const auto altitude = std::isnan(command.z) ? std::optional{here.altitude_msl}
                                              : altitude_in_frame(frame, double{command.z}, flight_.home());
  if (!altitude || !std::isfinite(altitude->value)) return std::nullopt;
  if (is_px4() && (std::isnan(command.x) || std::isnan(command.y)))
    return Position{here.latitude, here.longitude, *altitude};
  return place_of(command, *altitude);
}

/// ArduPilot takes it as COMMAND_INT only. Parameter 1 is a speed, 3 a plane's radius, 4 where the nose points.
std::uint8_t Autopilot::reposition(const Command& command, Call& call) {
  if (!command.frame && !is_px4()) return messages::MAV_RESULT_UNSUPPORTED;
  if (command.frame && !altitude_in_frame(*command.frame, 0, flight_.home()))
    return messages::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME;
  GuidedTarget target{.position = place_or_here(command)};
  if (!target.position) return messages::MAV_RESULT_DENIED;
  if (command.param1 > 0) target.speed = MetresPerSecond{command.param1};
  const bool is_plane = flight_.kind().type == AirframeType::plane;
  if (is_plane && std::isfinite(command.param3) && command.param3 != 0) target.radius = Metres{command.param3};
  if (std::isfinite(command.param4)) target.heading = Radians{command.param4};
  const bool done = flight_.reposition(target, snapshot_.since_boot, call.airframe, facts_);
  tell_facts(call.speaker);
  return done ? std::uint8_t{messages::MAV_RESULT_ACCEPTED} : not_now();
}

/// PX4 only. Parameter 1 is the radius, 2 the speed.
std::uint8_t Autopilot::orbit(const Command& command, Call& call) {
  if (!is_px4()) return messages::MAV_RESULT_UNSUPPORTED;
  GuidedTarget target{.position = place_or_here(command)};
  if (!target.position) return messages::MAV_RESULT_DENIED;
  const bool has_radius = std::isfinite(command.param1) && command.param1 != 0;
  target.radius = has_radius ? Metres{command.param1} : Metres{memory_.parameters.value("NAV_LOITER_RAD")};
  if (command.param2 > 0) target.speed = MetresPerSecond{command.param2};
  const bool done = flight_.orbit(target, snapshot_.since_boot, call.airframe, facts_);
  tell_facts(call.speaker);
  return done ? std::uint8_t{messages::MAV_RESULT_ACCEPTED} : not_now();
}

/// ArduCopter only: to parameter 1 in degrees, or by it (parameter 4), then to the side of parameter 3.
std::uint8_t Autopilot::turn(const Command& command, Call& call) {
  if (is_px4() || flight_.kind().type == AirframeType::plane) return messages::MAV_RESULT_UNSUPPORTED;
  const bool is_sane = command.param1 >= 0 && command.param1 <= 360 && (command.param4 == 0 || command.param4 == 1);
  if (!is_sane || !snapshot_.armed) return messages::MAV_RESULT_FAILED;
  const auto heading = heading_after_turn(call.airframe.state().attitude.heading, double{command.param1},
                                          double{command.param3}, command.param4 == 1);
  if (flight_.mode() == FlightMode::guided) call.airframe.face({.heading = heading});
  return messages::MAV_RESULT_ACCEPTED;
}

/// To ArduPilot both parameters have to be 0. PX4 begins with the item of parameter 1, and arms.
std::uint8_t Autopilot::start_mission(const Command& command, Call& call) {
  if (is_px4()) {
    const auto items = static_cast<std::uint32_t>(memory_.missions.items(PlanType::mission).size());
    const auto first = whole_number(command.param1, 65535);
    if (!first || *first >= items) return messages::MAV_RESULT_DENIED;
    const auto now = snapshot_.since_boot;
    const bool can = flight_.set_current_item(static_cast<std::uint16_t>(*first), now, call.airframe, facts_);
    tell_facts(call.speaker);
    if (!can) return not_now();
    const auto mode = enter(FlightMode::automatic, call);
    return mode == messages::MAV_RESULT_ACCEPTED ? arm(call) : mode;
  }
  if (command.param1 != 0 || command.param2 != 0) return messages::MAV_RESULT_DENIED;
  const bool done = flight_.start_mission(snapshot_.since_boot, call.airframe, facts_);
  tell_facts(call.speaker);
  return done ? messages::MAV_RESULT_ACCEPTED : messages::MAV_RESULT_FAILED;
}

/// Of a copter's mission: parameter 1 is 0 to pause, 1 to continue.
std::uint8_t Autopilot::pause_or_continue(const Command& command, Call& call) {
  if (is_px4() || flight_.kind().type == AirframeType::plane) return messages::MAV_RESULT_UNSUPPORTED;
  if (command.param1 != 0 && command.param1 != 1) return messages::MAV_RESULT_DENIED;
  const bool pauses = command.param1 == 0;
  const auto now = snapshot_.since_boot;
  const bool done =
      pauses ? flight_.pause_mission(now, call.airframe, facts_) : flight_.continue_mission(now, call.airframe, facts_);
  if (done) return messages::MAV_RESULT_ACCEPTED;
  call.speaker.say(messages::MAV_SEVERITY_INFO, pauses ? "Failed to pause" : "Failed to resume");
  return messages::MAV_RESULT_FAILED;
}

std::uint8_t Autopilot::set_mission_item(const Command& command, Call& call) {
  const auto item = whole_number(command.param1, 65535);
  if (!item || *item >= memory_.missions.items(PlanType::mission).size()) return messages::MAV_RESULT_DENIED;
  const bool done =
      flight_.set_current_item(static_cast<std::uint16_t>(*item), snapshot_.since_boot, call.airframe, facts_);
  tell_facts(call.speaker);
  if (!done) return messages::MAV_RESULT_DENIED;
  snapshot_.mission = mission_progress();
  send_row(messages::MissionCurrent::info.id, call.speaker);
  return messages::MAV_RESULT_ACCEPTED;
}

/// Parameter 2, in m/s; negative leaves it as it is.
std::uint8_t Autopilot::change_speed(const Command& command, Call& call) {
  if (!snapshot_.armed) return not_now();
  if (!std::isfinite(command.param2)) return messages::MAV_RESULT_DENIED;
  if (command.param2 > 0)
    flight_.change_speed(MetresPerSecond{command.param2}, snapshot_.since_boot, call.airframe, facts_);
  tell_facts(call.speaker);
  return messages::MAV_RESULT_ACCEPTED;
}

/// To where it is (parameter 1), or to a place.
std::uint8_t Autopilot::set_home(const Command& command, Call& call) {
  if (!snapshot_.has_position) return not_now();
  const auto altitude =
      altitude_in_frame(command.frame.value_or(messages::MAV_FRAME_GLOBAL), double{command.z}, flight_.home());
  auto home = command.param1 == 1 ? std::optional{snapshot_.readings.position}
              : altitude          ? place_of(command, *altitude)
                                  : std::nullopt;
  if (!home || !(std::abs(home->altitude_msl.value) < 10'000)) return messages::MAV_RESULT_DENIED;
  flight_.set_home(*home);
  snapshot_.home = *home;
  keep_home();
  send_row(messages::HomePosition::info.id, call.speaker);
  return messages::MAV_RESULT_ACCEPTED;
}

/// Setpoints are never acknowledged.
void Autopilot::guide(const std::optional<GuidedTarget>& target, Call& call) {
  if (!target || !snapshot_.has_position) return;
  static_cast<void>(flight_.guide(*target, snapshot_.since_boot, call.airframe, facts_));
  tell_facts(call.speaker);
}

}  // namespace ponte::sim
