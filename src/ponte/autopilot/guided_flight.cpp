#include "ponte/autopilot/guided_flight.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using vehicle::ModeKind;
using Kind = GuidedFact::Kind;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float own_speed = -1;

bool is_valid(const Target& target) {
  return std::abs(target.latitude.value) <= std::numbers::pi / 2 &&
         std::abs(target.longitude.value) <= std::numbers::pi && std::isfinite(target.height.value.value);
}

bool is_valid(const std::optional<MetresPerSecond>& speed) {
  return !speed || (std::isfinite(speed->value) && speed->value > 0);
}

void set_place(Command& command, const Target& target) {
  command.x = degrees_from_radians(target.latitude);
  command.y = degrees_from_radians(target.longitude);
  command.z = static_cast<float>(target.height.value.value);
  command.frame =
      target.height.above == Height::Above::home ? messages::MAV_FRAME_GLOBAL_RELATIVE_ALT : messages::MAV_FRAME_GLOBAL;
}

/// What is left open stays as it is.
Command reposition() {
  return {.number = messages::MAV_CMD_DO_REPOSITION,
          .param1 = own_speed,
          .param2 = static_cast<float>(messages::MAV_DO_REPOSITION_FLAGS_CHANGE_MODE),
          .param4 = nan,
          .x = nan,
          .y = nan,
          .z = nan};
}

bool leads_somewhere(GuidedWish wish) { return wish != GuidedWish::change_speed; }

}  // namespace

GuidedFlight::GuidedFlight(CommandClient& commands, const ModeClient& modes) : commands_{commands}, modes_{modes} {
  pending_.reserve(CommandClient::capacity);
}

Result<GuidedRequestId, GuidedError> GuidedFlight::go_to(Timestamp now, const Target& target,
                                                         std::optional<MetresPerSecond> speed, Voice& voice) {
  if (!is_valid(target) || !is_valid(speed)) return fail(GuidedError::invalid);
  auto command = reposition();
  set_place(command, target);
  if (speed) command.param1 = static_cast<float>(speed->value);
  const auto result = ask(now, GuidedWish::go_to, command, guided_mode(), voice);
  if (result) target_ = target;
  return result;
}

Result<GuidedRequestId, GuidedError> GuidedFlight::orbit(Timestamp now, const Target& centre, Metres radius,
                                                         std::optional<MetresPerSecond> speed, Voice& voice) {
  if (!is_valid(centre) || !is_valid(speed) || !std::isfinite(radius.value) || radius.value == 0)
    return fail(GuidedError::invalid);
  if (stack() == Stack::ardupilot_plane) {
    auto command = reposition();
    set_place(command, centre);
    if (speed) command.param1 = static_cast<float>(speed->value);
    command.param3 = static_cast<float>(std::abs(radius.value));
    command.param4 = radius.value < 0 ? 1 : 0;  // anticlockwise
    return ask(now, GuidedWish::orbit, command, guided_mode(), voice);
  }
  if (stack() != Stack::px4) return fail(GuidedError::not_supported);
  Command command{.number = messages::MAV_CMD_DO_ORBIT,
                  .param1 = static_cast<float>(radius.value),
                  .param2 = speed ? static_cast<float>(speed->value) : nan,
                  .param4 = nan};
  set_place(command, centre);
  return ask(now, GuidedWish::orbit, command, custom_mode_named(stack(), "POSCTL.ORBIT"), voice);
}

Result<GuidedRequestId, GuidedError> GuidedFlight::change_altitude(Timestamp now, const Height& height, Voice& voice) {
  if (!std::isfinite(height.value.value)) return fail(GuidedError::invalid);
  auto command = reposition();
  if (stack() == Stack::px4) {
    const auto home = commands_.home_altitude_msl();
    if (height.above == Height::Above::home && !home) return fail(GuidedError::home_unknown);
    const auto base = height.above == Height::Above::home ? *home : Metres{};
    command.z = static_cast<float>((base + height.value).value);
    return ask(now, GuidedWish::change_altitude, command, guided_mode(), voice);
  }
  const auto mode = guided_mode();
  const auto& place = modes_.watch().place();
  if (!place) return fail(GuidedError::position_unknown);
  const bool is_led = target_ && mode && modes_.watch().has_mode(*mode, Timestamp{});
  set_place(command, is_led ? Target{target_->latitude, target_->longitude, height}
                            : Target{place->latitude, place->longitude, height});
  return ask(now, GuidedWish::change_altitude, command, mode, voice);
}

Result<GuidedRequestId, GuidedError> GuidedFlight::turn_to(Timestamp now, Radians heading, Voice& voice) {
  if (!std::isfinite(heading.value)) return fail(GuidedError::invalid);
  if (stack() == Stack::px4) {
    auto command = reposition();
    command.param4 = static_cast<float>(heading.value);
    return ask(now, GuidedWish::turn_to, command, guided_mode(), voice);
  }
  if (stack() != Stack::ardupilot_copter) return fail(GuidedError::not_supported);
  constexpr double full_turn = 360;
  const double degrees = std::fmod(degrees_from_radians(heading), full_turn);
  const Command command{.number = messages::MAV_CMD_CONDITION_YAW,
                        .param1 = static_cast<float>(degrees < 0 ? degrees + full_turn : degrees)};
  return ask(now, GuidedWish::turn_to, command, std::nullopt, voice);
}

Result<GuidedRequestId, GuidedError> GuidedFlight::change_speed(Timestamp now, MetresPerSecond speed, Voice& voice) {
  if (!is_valid(std::optional{speed})) return fail(GuidedError::invalid);
  const auto type =
      stack() == Stack::ardupilot_plane ? messages::SPEED_TYPE_AIRSPEED : messages::SPEED_TYPE_GROUNDSPEED;
  const Command command{.number = messages::MAV_CMD_DO_CHANGE_SPEED,
                        .param1 = static_cast<float>(type),
                        .param2 = static_cast<float>(speed.value),
                        .param3 = -1};  // the throttle as it is
  return ask(now, GuidedWish::change_speed, command, std::nullopt, voice);
}

/// PX4 flies to a place given by a command in its hold mode.
std::optional<std::uint32_t> GuidedFlight::guided_mode() const {
  return custom_mode_for(stack(), stack() == Stack::px4 ? ModeKind::hold : ModeKind::guided);
}

Result<GuidedRequestId, GuidedError> GuidedFlight::ask(Timestamp now, GuidedWish wish, const Command& command,
                                                       std::optional<std::uint32_t> custom_mode, Voice& voice) {
  if (stack() == Stack::unknown) return fail(GuidedError::not_supported);
  if (pending_.size() == pending_.capacity()) return fail(GuidedError::not_sent);
  for (auto& each : pending_) {
    if (!leads_somewhere(wish) || !leads_somewhere(each.wish) || each.phase == Phase::superseded) continue;
    if (each.phase == Phase::asked) commands_.withdraw(now, each.command);
    each.phase = Phase::superseded;
    each.deadline = now;
  }
  const auto request = commands_.request(now, command, voice);
  if (!request) return fail(GuidedError::not_sent);
  pending_.push_back(
      {.id = GuidedRequestId{++last_id_}, .wish = wish, .command = *request, .since = now, .custom_mode = custom_mode});
  return pending_.back().id;
}

bool GuidedFlight::on_answer(Timestamp now, const CommandFact& answer, Outbox<GuidedFact>& facts) {
  const auto is_asked = [&](const Pending& each) {
    return each.phase == Phase::asked && each.command == answer.request;
  };
  const auto found = std::ranges::find_if(pending_, is_asked);
  if (found == pending_.end()) return false;
  if (!answer.is_final()) return true;
  if (answer.kind == CommandFact::Kind::accepted) {
    found->phase = Phase::accepted;
    found->deadline = now + (found->custom_mode ? mode_patience : Duration{});
    on_tick(now, facts);
    return true;
  }
  GuidedFact fact{.kind = Kind::no_answer, .request = found->id, .wish = found->wish};
  if (answer.kind == CommandFact::Kind::refused) {
    fact.kind = Kind::refused;
    fact.result = answer.result;
    fact.reason = answer.reason;
  }
  facts.push(fact);
  pending_.erase(found);
  return true;
}

void GuidedFlight::on_tick(Timestamp now, Outbox<GuidedFact>& facts) {
  std::erase_if(pending_, [&](const Pending& each) {
    if (each.phase == Phase::asked) return false;
    const bool is_seen = !each.custom_mode || modes_.watch().has_mode(*each.custom_mode, each.since);
    if (each.phase == Phase::accepted && is_seen)
      tell(each, Kind::done, facts);
    else if (each.deadline <= now)
      tell(each, each.phase == Phase::accepted ? Kind::no_effect : Kind::superseded, facts);
    else
      return false;
    return true;
  });
}

std::optional<Timestamp> GuidedFlight::next_deadline() const {
  std::optional<Timestamp> next;
  for (const auto& each : pending_)
    if (each.phase != Phase::asked && (!next || each.deadline < *next)) next = each.deadline;
  return next;
}

void GuidedFlight::on_reboot(Timestamp now, Outbox<GuidedFact>& facts) {
  for (const auto& each : pending_) {
    if (each.phase == Phase::asked) commands_.withdraw(now, each.command);
    tell(each, each.phase == Phase::superseded ? Kind::superseded : Kind::rebooted, facts);
  }
  pending_.clear();
  target_.reset();
}

void GuidedFlight::tell(const Pending& pending, Kind kind, Outbox<GuidedFact>& facts) {
  facts.push({.kind = kind, .request = pending.id, .wish = pending.wish});
}

}  // namespace ponte::autopilot
