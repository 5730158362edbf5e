#include "ponte/autopilot/setpoint_stream.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/set_position_target_local_ned.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using vehicle::ModeKind;
using Kind = StreamFact::Kind;

// POSITION_TARGET_TYPEMASK: all but the velocity is to be ignored, in whole groups, as ArduPilot wants it.
constexpr std::uint16_t velocity_only = 0x0DC7;
constexpr std::uint16_t velocity_and_turn_rate = 0x05C7;

/// A HEARTBEAT may overtake another by less than this.
constexpr Duration heartbeat_disorder = std::chrono::seconds{1};

bool is_valid(const Motion& motion) {
  return std::isfinite(motion.north.value) && std::isfinite(motion.east.value) && std::isfinite(motion.down.value) &&
         (!motion.turn_rate || std::isfinite(motion.turn_rate->value));
}

}  // namespace

SetpointStream::SetpointStream(const Peer& peer, ModeClient& modes, const StreamTimes& times)
    : peer_{peer}, modes_{modes}, times_{times} {}

Result<void, StreamError> SetpointStream::steer(Timestamp now, const Motion& motion, Voice& voice) {
  if (peer_.stack != Stack::ardupilot_copter && peer_.stack != Stack::px4) return fail(StreamError::not_supported);
  if (!is_valid(motion)) return fail(StreamError::invalid);
  if (phase_ == Phase::none || phase_ == Phase::holding) {
    if (!modes_.watch().is_in_the_air(now - ModeTimes{}.news)) return fail(StreamError::on_the_ground);
    if (peer_.stack == Stack::px4) {
      forget_mode_request(now);
      enter(now, Phase::before_switch, times_.before_switch);
    } else {
      if (!ask_for(now, ModeKind::guided, voice)) return fail(StreamError::not_sent);
      enter(now, Phase::switching, {});
    }
    next_setpoint_ = now;
  }
  motion_ = motion;
  fed_ = now;
  return {};
}

void SetpointStream::stop(Timestamp now) { fed_ = now - times_.dead_man; }

void SetpointStream::enter(Timestamp now, Phase phase, Duration lasts) {
  phase_ = phase;
  phase_since_ = now;
  phase_ends_ = now + lasts;
}

bool SetpointStream::on_mode_fact(Timestamp now, const ModeFact& fact, Outbox<StreamFact>& facts) {
  if (!mode_request_ || fact.request != *mode_request_) return false;
  mode_request_.reset();
  if (phase_ == Phase::holding) {
    end({.kind = fact.kind == ModeFact::Kind::superseded ? Kind::mode_left : Kind::held}, facts);
  } else if (phase_ == Phase::switching && fact.kind == ModeFact::Kind::done) {
    enter(now, Phase::steering, {});
    facts.push({.kind = Kind::steers});
  } else if (phase_ == Phase::switching) {
    const bool is_left = fact.kind == ModeFact::Kind::superseded;
    end({.kind = is_left ? Kind::mode_left : Kind::refused, .result = fact.result, .reason = fact.reason}, facts);
  }
  return true;
}

void SetpointStream::on_tick(Timestamp now, Voice& voice, Outbox<StreamFact>& facts) {
  if (phase_ == Phase::none) return;
  advance(now, voice, facts);
  if (phase_ == Phase::none || now < next_setpoint_) return;
  send(now, phase_ == Phase::holding ? Motion{} : motion_, voice);
}

void SetpointStream::advance(Timestamp now, Voice& voice, Outbox<StreamFact>& facts) {
  if (phase_ == Phase::holding) {
    if (!mode_request_ && now >= phase_ends_) end({.kind = Kind::held}, facts);
    return;
  }
  if (now >= fed_ + times_.dead_man) {
    if (phase_ == Phase::before_switch) return end({.kind = Kind::held}, facts);
    return begin_holding(now, voice);
  }
  if (phase_ == Phase::before_switch && now >= phase_ends_) {
    if (!ask_for(now, ModeKind::guided, voice)) return end({.kind = Kind::refused}, facts);
    enter(now, Phase::switching, {});
  }
  const auto mode = custom_mode_for(peer_.stack, ModeKind::guided).value();
  if (phase_ == Phase::steering && modes_.watch().has_other_mode(mode, phase_since_ + heartbeat_disorder))
    end({.kind = Kind::mode_left}, facts);
}

void SetpointStream::begin_holding(Timestamp now, Voice& voice) {
  enter(now, Phase::holding, times_.hold);
  next_setpoint_ = now;
  if (peer_.stack == Stack::px4)
    ask_for(now, ModeKind::hold, voice);
  else
    forget_mode_request(now);
}

bool SetpointStream::ask_for(Timestamp now, ModeKind mode, Voice& voice) {
  forget_mode_request(now);
  const auto request = modes_.change_mode(now, mode, voice);
  if (request) mode_request_ = *request;
  return request.has_value();
}

void SetpointStream::forget_mode_request(Timestamp now) {
  if (mode_request_) modes_.withdraw(now, *mode_request_);
  mode_request_.reset();
}

void SetpointStream::send(Timestamp now, const Motion& motion, Voice& voice) {
  next_setpoint_ = now + times_.period;
  voice.send(messages::SetPositionTargetLocalNed{
      .target_system = peer_.system.value,
      .target_component = peer_.component.value,
      .coordinate_frame = messages::MAV_FRAME_LOCAL_NED,
      .type_mask = motion.turn_rate ? velocity_and_turn_rate : velocity_only,
      .vx = static_cast<float>(motion.north.value),
      .vy = static_cast<float>(motion.east.value),
      .vz = static_cast<float>(motion.down.value),
      .yaw_rate = static_cast<float>(motion.turn_rate.value_or(RadiansPerSecond{}).value)});
}

std::optional<Timestamp> SetpointStream::next_deadline() const {
  switch (phase_) {
    case Phase::none: return std::nullopt;
    case Phase::before_switch: return std::min({next_setpoint_, fed_ + times_.dead_man, phase_ends_});
    case Phase::switching:
    case Phase::steering: return std::min(next_setpoint_, fed_ + times_.dead_man);
    case Phase::holding: return mode_request_ ? next_setpoint_ : std::min(next_setpoint_, phase_ends_);
  }
  return std::nullopt;
}

void SetpointStream::on_reboot(Timestamp now, Outbox<StreamFact>& facts) {
  forget_mode_request(now);
  if (phase_ != Phase::none) end({.kind = Kind::rebooted}, facts);
}

void SetpointStream::end(const StreamFact& fact, Outbox<StreamFact>& facts) {
  phase_ = Phase::none;
  facts.push(fact);
}

}  // namespace ponte::autopilot
