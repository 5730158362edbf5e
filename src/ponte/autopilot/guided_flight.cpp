#include "ponte/autopilot/guided_flight.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"

#include <cmath>
#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using vehicle::ModeKind;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float own_speed = -1;

bool is_valid(const std::optional<MetresPerSecond>& speed) {
  return !speed || (std::isfinite(speed->value) && speed->value > 0);
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

GuidedFlight::GuidedFlight(CommandClient& commands, const ModeClient& modes)
    : commands_{commands}, modes_{modes}, wishes_{commands} {}

Result<GuidedRequestId, GuidedError> GuidedFlight::go_to(Timestamp now, const Target& target,
                                                         std::optional<MetresPerSecond> speed, Voice& voice) {
  if (!is_valid(target) || !is_valid(speed)) return fail(GuidedError::invalid);
  const auto understood = as_understood(target);
  if (!understood) return fail(GuidedError::home_unknown);
  auto command = reposition();
  set_place(command, *understood);
  if (speed) command.param1 = static_cast<float>(speed->value);
  const auto result = ask(now, GuidedWish::go_to, command, voice);
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
    return ask(now, GuidedWish::orbit, command, voice);
  }
  if (stack() != Stack::px4) return fail(GuidedError::not_supported);
  const auto understood = as_understood(centre);
  if (!understood) return fail(GuidedError::home_unknown);
  Command command{.number = messages::MAV_CMD_DO_ORBIT,
                  .param1 = static_cast<float>(radius.value),
                  .param2 = speed ? static_cast<float>(speed->value) : nan,
                  .param4 = nan};
  set_place(command, *understood);
  return ask(now, GuidedWish::orbit, command, voice);
}

Result<GuidedRequestId, GuidedError> GuidedFlight::change_altitude(Timestamp now, const Height& height, Voice& voice) {
  if (!std::isfinite(height.value.value)) return fail(GuidedError::invalid);
  auto command = reposition();
  if (stack() == Stack::px4) {
    const auto home = commands_.home_altitude_msl();
    if (height.above == Height::Above::home && !home) return fail(GuidedError::home_unknown);
    const auto base = height.above == Height::Above::home ? *home : Metres{};
    command.z = static_cast<float>((base + height.value).value);
    return ask(now, GuidedWish::change_altitude, command, voice);
  }
  const auto mode = guided_mode();
  const auto& place = modes_.watch().place();
  if (!place) return fail(GuidedError::position_unknown);
  const bool is_led = target_ && mode && modes_.watch().has_mode(*mode, Timestamp{});
  set_place(command, is_led ? Target{target_->latitude, target_->longitude, height}
                            : Target{place->latitude, place->longitude, height});
  return ask(now, GuidedWish::change_altitude, command, voice);
}

Result<GuidedRequestId, GuidedError> GuidedFlight::turn_to(Timestamp now, Radians heading, Voice& voice) {
  if (!std::isfinite(heading.value)) return fail(GuidedError::invalid);
  if (stack() == Stack::px4) {
    auto command = reposition();
    command.param4 = static_cast<float>(heading.value);
    return ask(now, GuidedWish::turn_to, command, voice);
  }
  if (stack() != Stack::ardupilot_copter) return fail(GuidedError::not_supported);
  constexpr double full_turn = 360;
  const double degrees = std::fmod(degrees_from_radians(heading), full_turn);
  const Command command{.number = messages::MAV_CMD_CONDITION_YAW,
                        .param1 = static_cast<float>(degrees < 0 ? degrees + full_turn : degrees)};
  return ask(now, GuidedWish::turn_to, command, voice);
}

Result<GuidedRequestId, GuidedError> GuidedFlight::change_speed(Timestamp now, MetresPerSecond speed, Voice& voice) {
  if (!is_valid(std::optional{speed})) return fail(GuidedError::invalid);
  const auto type =
      stack() == Stack::ardupilot_plane ? messages::SPEED_TYPE_AIRSPEED : messages::SPEED_TYPE_GROUNDSPEED;
  const Command command{.number = messages::MAV_CMD_DO_CHANGE_SPEED,
                        .param1 = static_cast<float>(type),
                        .param2 = static_cast<float>(speed.value),
                        .param3 = -1};  // the throttle as it is
  return ask(now, GuidedWish::change_speed, command, voice);
}

/// Not all releases of PX4 look at the frame of a command: to it all altitudes are above mean sea level.
std::optional<Target> GuidedFlight::as_understood(const Target& target) const {
  return stack() == Stack::px4 ? above_sea(target, commands_.home_altitude_msl()) : std::optional{target};
}

/// PX4 flies to a place given by a command in its hold mode.
std::optional<std::uint32_t> GuidedFlight::guided_mode() const {
  return custom_mode_for(stack(), stack() == Stack::px4 ? ModeKind::hold : ModeKind::guided);
}

/// In which it can be seen to be done; nothing if it changes none.
std::optional<std::uint32_t> GuidedFlight::mode_of(GuidedWish wish) const {
  const bool is_px4 = stack() == Stack::px4;
  if (wish == GuidedWish::change_speed || (wish == GuidedWish::turn_to && !is_px4)) return std::nullopt;
  if (wish == GuidedWish::orbit && is_px4) return custom_mode_named(stack(), "POSCTL.ORBIT");
  return guided_mode();
}

Result<GuidedRequestId, GuidedError> GuidedFlight::ask(Timestamp now, GuidedWish wish, const Command& command,
                                                       Voice& voice) {
  if (stack() == Stack::unknown) return fail(GuidedError::not_supported);
  if (leads_somewhere(wish)) wishes_.supersede(now, leads_somewhere);
  const auto request = wishes_.ask(now, wish, command, mode_of(wish) ? mode_patience : Duration{}, voice);
  if (!request) return fail(GuidedError::not_sent);
  return *request;
}

bool GuidedFlight::on_answer(Timestamp now, const CommandFact& answer, Outbox<GuidedFact>& facts) {
  if (!wishes_.on_answer(now, answer, facts)) return false;
  on_tick(now, facts);
  return true;
}

void GuidedFlight::on_tick(Timestamp now, Outbox<GuidedFact>& facts) {
  const auto is_seen = [this](GuidedWish wish, Timestamp since) {
    const auto mode = mode_of(wish);
    return !mode || modes_.watch().has_mode(*mode, since);
  };
  wishes_.look(now, is_seen, facts);
}

std::optional<Timestamp> GuidedFlight::next_deadline() const { return wishes_.next_deadline(); }

void GuidedFlight::on_reboot(Timestamp now, Outbox<GuidedFact>& facts) {
  wishes_.on_reboot(now, facts);
  target_.reset();
}

}  // namespace ponte::autopilot
