#pragma once

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/sim/copter.hpp"
#include "ponte/sim/flight.hpp"
#include "ponte/sim/settings.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace ponte::sim {

namespace messages = mavlink::autopilots;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Position field{radians_from_degrees(-30.06898), radians_from_degrees(-51.12179), Metres{50}};

/// A flight of any aircraft in virtual time, without a word of MAVLink on a wire.
class FlightRig {
 public:
  FlightRig(VehicleKind kind, std::unique_ptr<Airframe> airframe)
      : kind_{kind},
        airframe_{std::move(airframe)},
        flight_{kind, settings_of(kind, Parameters{kind.personality, kind.type}).flight, false, {}} {
    flight_.set_home(field);
    flight_.set_has_position(true);
  }

  /// As from an upload: to ArduPilot the home item comes first.
  void load(std::vector<MissionItem> items) {
    items_ = std::move(items);
    if (kind_.personality == Personality::ardupilot)
      items_.insert(items_.begin(), MissionItem{.command = messages::MAV_CMD_NAV_WAYPOINT});
    flight_.set_mission(items_);
  }

  void arm() {
    airframe_->arm();
    flight_.set_home(field);
    flight_.on_armed(now_, *airframe_, facts_);
  }
  bool enter(FlightMode mode) { return flight_.enter(mode, now_, *airframe_, facts_); }
  bool start_mission() { return flight_.start_mission(now_, *airframe_, facts_); }
  bool take_off(double height) { return flight_.take_off(Metres{height}, now_, *airframe_, facts_); }
  bool guide(const GuidedTarget& target) { return flight_.guide(target, now_, *airframe_, facts_); }
  bool reposition(const GuidedTarget& target) { return flight_.reposition(target, now_, *airframe_, facts_); }
  bool pause_mission() { return flight_.pause_mission(now_, *airframe_, facts_); }
  bool continue_mission() { return flight_.continue_mission(now_, *airframe_, facts_); }
  bool set_item(std::uint16_t item) { return flight_.set_current_item(item, now_, *airframe_, facts_); }
  void change_speed(double speed) { flight_.change_speed(MetresPerSecond{speed}, now_, *airframe_, facts_); }

  void step() {
    now_ += Airframe::step_length;
    if (before_step) before_step(now_, flight_, *airframe_, facts_);
    flight_.step(now_, *airframe_, facts_);
    airframe_->step(conditions_);
    facts_.drain([this](const FlightFact& fact) {
      if (const auto* text = std::get_if<Notice>(&fact)) texts.emplace_back(text->text.view());
      if (const auto* done = std::get_if<ItemReached>(&fact)) reached.push_back(done->item);
    });
  }
  void wait(Duration duration) {
    for (const auto end = now_ + duration; now_ < end;) step();
  }
  /// False if it never happens.
  template <class Condition>
  bool wait_until(Condition&& condition, Duration limit) {
    for (const auto end = now_ + limit; now_ < end && !condition();) step();
    return condition();
  }

  [[nodiscard]] const AirframeState& state() const { return airframe_->state(); }
  [[nodiscard]] NorthEastDown place() const { return offset_between(field, state().position); }
  [[nodiscard]] double height() const { return -place().down; }
  [[nodiscard]] const Flight& flight() const { return flight_; }
  [[nodiscard]] FlightMode mode() const { return flight_.mode(); }
  [[nodiscard]] std::uint16_t current() const { return flight_.mission().current(); }
  [[nodiscard]] Duration now() const { return now_; }

  [[nodiscard]] bool is_flying() const { return state().airborne; }
  Conditions& conditions() { return conditions_; }
  Flight& flight() { return flight_; }
  /// What an autopilot does before it flies on.
  std::function<void(Duration, Flight&, Airframe&, Outbox<FlightFact>&)> before_step;
  std::vector<std::string> texts;
  std::vector<unsigned> reached;

 private:
  VehicleKind kind_;
  std::unique_ptr<Airframe> airframe_;
  Flight flight_;
  Conditions conditions_{};
  Outbox<FlightFact> facts_{64};
  std::vector<MissionItem> items_;
  Duration now_{};
};

/// An item at a place north and east of the field (m), at a height above home; the parameters are p1 to p4.
inline MissionItem item_at(unsigned command, const NorthEastDown& place, std::array<float, 4> p = {}) {
  const auto position = displaced(field, place);
  const auto degrees_e7 = [](Radians angle) {
    return static_cast<std::int32_t>(std::lround(angle.value * 180 / std::numbers::pi * 1e7));
  };
  return {.frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT,
          .command = static_cast<std::uint16_t>(command),
          .autocontinue = 1,
          .param1 = p[0],
          .param2 = p[1],
          .param3 = p[2],
          .param4 = p[3],
          .x = degrees_e7(position.latitude),
          .y = degrees_e7(position.longitude),
          .z = static_cast<float>(-place.down)};
}

/// An item without a place.
inline MissionItem item(unsigned command, std::array<float, 4> p = {}) {
  return {.frame = messages::MAV_FRAME_MISSION,
          .command = static_cast<std::uint16_t>(command),
          .autocontinue = 1,
          .param1 = p[0],
          .param2 = p[1],
          .param3 = p[2],
          .param4 = p[3]};
}

}  // namespace ponte::sim
