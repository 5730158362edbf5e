#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/mavlink/autopilots/mission_set_current.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/sim/autopilot.hpp"
#include "ponte/sim/telemetry_messages.hpp"

/// Between the plans on board and the flight.
namespace ponte::sim {

/// Item 0 of ArduPilot's missions is home, whatever was uploaded.
void Autopilot::keep_home() {
  if (is_px4()) return;
  const auto& home = flight_.home();
  memory_.missions.put(PlanType::mission, 0,
                       {.frame = messages::MAV_FRAME_GLOBAL,
                        .command = messages::MAV_CMD_NAV_WAYPOINT,
                        .autocontinue = 1,
                        .x = degrees_e7(home.latitude),
                        .y = degrees_e7(home.longitude),
                        .z = static_cast<float>(home.altitude_msl.value)});
}

/// After each change of a plan: the flight has to know, and ArduPilot tells how many items there are.
void Autopilot::take_over_plans(Speaker& speaker) {
  auto& missions = memory_.missions;
  if (mission_change_ != missions.changes(PlanType::mission)) {
    if (!missions.items(PlanType::mission).empty() && snapshot_.has_position) keep_home();
    mission_change_ = missions.changes(PlanType::mission);
    flight_.set_mission(missions.items(PlanType::mission));
    snapshot_.mission = mission_progress();
  }
  if (fence_change_ != missions.changes(PlanType::fence)) {
    fence_change_ = missions.changes(PlanType::fence);
    failsafes_.set_fence(missions.items(PlanType::fence));
  }
  if (is_px4()) return;
  parameters_.announce("MIS_TOTAL", static_cast<double>(missions.items(PlanType::mission).size()), speaker);
  parameters_.announce("FENCE_TOTAL", static_cast<double>(missions.items(PlanType::fence).size()), speaker);
  parameters_.announce("RALLY_TOTAL", static_cast<double>(missions.items(PlanType::rally).size()), speaker);
}

MissionProgress Autopilot::mission_progress() const {
  const auto& missions = memory_.missions;
  const auto& flown = flight_.mission();
  const bool is_flown = flight_.mode() == FlightMode::automatic;
  const auto state = [&] {
    if (!flown.has_items()) return messages::MISSION_STATE_NO_MISSION;
    if (flown.is_finished()) return messages::MISSION_STATE_COMPLETE;
    if (is_flown) return messages::MISSION_STATE_ACTIVE;
    return snapshot_.armed && flown.current() > 1 ? messages::MISSION_STATE_PAUSED
                                                  : messages::MISSION_STATE_NOT_STARTED;
  }();
  return {
      .current = flown.has_items() ? flown.current() : std::uint16_t{},
      .items = static_cast<std::uint16_t>(missions.items(PlanType::mission).size()),
      .state = static_cast<std::uint8_t>(state),
      .is_flown = is_flown,
      .ids = {missions.id(PlanType::mission), missions.id(PlanType::fence), missions.id(PlanType::rally)},
  };
}

/// MISSION_SET_CURRENT: success is a MISSION_CURRENT; failure is told by PX4 only, as text.
void Autopilot::on_set_current(const mavlink::FrameView& frame, Call& call) {
  const auto wish = mavlink::decode<messages::MissionSetCurrent>(frame);
  if (!is_for_us(wish.target_system)) return;
  const bool done = wish.seq < memory_.missions.items(PlanType::mission).size() &&
                    flight_.set_current_item(wish.seq, snapshot_.since_boot, call.airframe, facts_);
  tell_facts(call.speaker);
  if (!done) {
    if (is_px4()) call.speaker.say(messages::MAV_SEVERITY_CRITICAL, "WPM: WP CURR CMD: Not in list\t");
    return;
  }
  snapshot_.mission = mission_progress();
  send_row(messages::MissionCurrent::info.id, call.speaker);
}

}  // namespace ponte::sim
