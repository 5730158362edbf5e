#include "ponte/autopilot/mode_client.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using vehicle::ModeKind;
using Kind = ModeFact::Kind;

/// How a flight begins from the ground: in this mode the vehicle is armed, and then told to go, where arming is not
/// enough.
struct Beginning {
  ModeWish wish;
  Stack stack;
  ModeKind mode;
  std::optional<ModeStep> then;
};
constexpr std::array beginnings{
    Beginning{ModeWish::start_mission, Stack::ardupilot_copter, ModeKind::guided, ModeStep::start_mission},
    Beginning{ModeWish::start_mission, Stack::ardupilot_plane, ModeKind::mission, std::nullopt},
    Beginning{ModeWish::start_mission, Stack::px4, ModeKind::mission, std::nullopt},
    Beginning{ModeWish::take_off, Stack::ardupilot_copter, ModeKind::guided, ModeStep::take_off},
    Beginning{ModeWish::take_off, Stack::ardupilot_plane, ModeKind::take_off, std::nullopt},
    Beginning{ModeWish::take_off, Stack::px4, ModeKind::hold, ModeStep::take_off},
};

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// DO_SET_MODE: PX4 has the main mode in parameter 2 and the sub mode in parameter 3.
Command set_mode(Stack stack, std::uint32_t custom_mode) {
  Command command{.number = messages::MAV_CMD_DO_SET_MODE,
                  .param1 = static_cast<float>(messages::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED)};
  if (stack == Stack::px4) {
    command.param2 = static_cast<float>(custom_mode >> 16U & 0xFFU);
    command.param3 = static_cast<float>(custom_mode >> 24U);
  } else {
    command.param2 = static_cast<float>(custom_mode);
  }
  return command;
}

}  // namespace

ModeClient::ModeClient(CommandClient& commands, const ModeTimes& times)
    : commands_{commands}, times_{times}, watch_{commands.peer()} {}

Result<ModeRequestId, ModeError> ModeClient::change_mode(Timestamp now, ModeKind kind, Voice& voice) {
  const auto mode = custom_mode_for(commands_.peer().stack, kind);
  if (!mode) return fail(ModeError::no_such_mode);
  return begin(now, {.wish = ModeWish::change_mode, .steps = {ModeStep::set_mode}, .count = 1, .mode = *mode}, voice);
}

Result<ModeRequestId, ModeError> ModeClient::change_mode(Timestamp now, std::string_view name, Voice& voice) {
  const auto mode = custom_mode_named(commands_.peer().stack, name);
  if (!mode) return fail(ModeError::no_such_mode);
  return begin(now, {.wish = ModeWish::change_mode, .steps = {ModeStep::set_mode}, .count = 1, .mode = *mode}, voice);
}

Result<ModeRequestId, ModeError> ModeClient::arm(Timestamp now, Voice& voice) {
  return begin(now, {.wish = ModeWish::arm, .steps = {ModeStep::arm}, .count = 1}, voice);
}

Result<ModeRequestId, ModeError> ModeClient::disarm(Timestamp now, Voice& voice) {
  return begin(now, {.wish = ModeWish::disarm, .steps = {ModeStep::disarm}, .count = 1}, voice);
}

Result<ModeRequestId, ModeError> ModeClient::take_off(Timestamp now, std::optional<Metres> height, Voice& voice) {
  const auto stack = commands_.peer().stack;
  if (stack == Stack::unknown) return fail(ModeError::unknown_stack);
  if (is_in_the_air(now)) return fail(ModeError::in_the_air);
  if (height && !(std::isfinite(height->value) && height->value > 0)) return fail(ModeError::height_invalid);
  if (!height && stack == Stack::ardupilot_copter) return fail(ModeError::needs_height);
  if (height && stack == Stack::ardupilot_plane) return fail(ModeError::has_own_height);
  Plan plan{.wish = ModeWish::take_off, .height = nan};
  if (height && stack == Stack::px4) {
    const auto home = commands_.home_altitude_msl();
    if (!home) return fail(ModeError::home_unknown);
    plan.height = static_cast<float>((*home + *height).value);
  } else if (height) {
    plan.height = static_cast<float>(height->value);
  }
  return begin_flight(now, plan, voice);
}

Result<ModeRequestId, ModeError> ModeClient::start_mission(Timestamp now, Voice& voice) {
  if (is_in_the_air(now)) return change_mode(now, ModeKind::mission, voice);
  return begin_flight(now, {.wish = ModeWish::start_mission}, voice);
}

Result<ModeRequestId, ModeError> ModeClient::begin_flight(Timestamp now, Plan plan, Voice& voice) {
  const auto stack = commands_.peer().stack;
  const auto is_ours = [&](const Beginning& row) { return row.wish == plan.wish && row.stack == stack; };
  const auto row = std::ranges::find_if(beginnings, is_ours);
  if (row == beginnings.end()) return fail(ModeError::unknown_stack);
  plan.steps = {ModeStep::set_mode, ModeStep::arm, row->then.value_or(ModeStep::arm)};
  plan.count = row->then ? 3 : 2;
  plan.mode = custom_mode_for(stack, row->mode).value();
  plan.final_mode = custom_mode_for(stack, ModeKind::mission).value();
  return begin(now, plan, voice);
}

Result<ModeRequestId, ModeError> ModeClient::begin(Timestamp now, const Plan& plan, Voice& voice) {
  if (!watch_.is_heard(now - times_.news)) return fail(ModeError::not_heard);
  if (superseded_.size() == most_superseded) return fail(ModeError::not_sent);
  if (running_) {
    if (running_->phase == Phase::asked) commands_.withdraw(now, running_->command);
    superseded_.push(fact(Kind::superseded));
    superseded_at_ = now;
  }
  running_ = Running{.id = ModeRequestId{++last_id_}, .plan = plan};
  if (ask(now, voice)) return running_->id;
  running_.reset();
  return fail(ModeError::not_sent);
}

void ModeClient::withdraw(Timestamp now, ModeRequestId request) {
  if (!running_ || running_->id != request) return;
  if (running_->phase == Phase::asked) commands_.withdraw(now, running_->command);
  running_.reset();
}

/// Sends the command of the step that it is at.
bool ModeClient::ask(Timestamp now, Voice& voice) {
  const auto command = commands_.request(now, command_for(running_->plan, running_->plan.steps[running_->at]), voice);
  if (!command) return false;
  running_->command = *command;
  running_->phase = Phase::asked;
  running_->step_began = now;
  return true;
}

Command ModeClient::command_for(const Plan& plan, ModeStep step) const {
  const auto stack = commands_.peer().stack;
  switch (step) {
    case ModeStep::set_mode: return set_mode(stack, plan.mode);
    case ModeStep::arm: return {.number = messages::MAV_CMD_COMPONENT_ARM_DISARM, .param1 = 1};
    case ModeStep::disarm: return {.number = messages::MAV_CMD_COMPONENT_ARM_DISARM, .param1 = 0};
    case ModeStep::start_mission: return {.number = messages::MAV_CMD_MISSION_START};
    case ModeStep::take_off: break;
  }
  Command command{.number = messages::MAV_CMD_NAV_TAKEOFF, .z = plan.height};
  if (stack == Stack::px4) {
    command.param4 = nan;  // the heading, and the place, are what they are
    command.x = command.y = nan;
  }
  return command;
}

void ModeClient::on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice, Outbox<ModeFact>& facts) {
  on_tick(now, facts);
  if (watch_.on_message(now, frame)) look(now, voice, facts);
}

bool ModeClient::on_answer(Timestamp now, const CommandFact& answer, Voice& voice, Outbox<ModeFact>& facts) {
  if (!running_ || running_->phase != Phase::asked || answer.request != running_->command) return false;
  if (!answer.is_final()) return true;
  running_->answer = answer;
  if (answer.kind == CommandFact::Kind::accepted) {
    on_accepted(now, voice, facts);
    return true;
  }
  // A copy of it may have been carried out, and only the answer got lost.
  if (answer.kind == CommandFact::Kind::refused && answer.attempts == 1) {
    finish(Kind::refused, facts);
    return true;
  }
  running_->phase = Phase::doubtful;
  running_->deadline = now + times_.doubt;
  look(now, voice, facts);
  return true;
}

void ModeClient::on_accepted(Timestamp now, Voice& voice, Outbox<ModeFact>& facts) {
  if (running_->at + 1 < running_->plan.count) {
    ++running_->at;
    if (!ask(now, voice)) finish(Kind::no_answer, facts);
    return;
  }
  const bool is_flight = running_->plan.wish == ModeWish::take_off || running_->plan.wish == ModeWish::start_mission;
  running_->phase = Phase::accepted;
  running_->deadline = now + (is_flight ? times_.flight : times_.mode);
  look(now, voice, facts);
}

void ModeClient::look(Timestamp now, Voice& voice, Outbox<ModeFact>& facts) {
  if (!running_) return;
  if (running_->phase == Phase::accepted && is_effect_seen()) return finish(Kind::done, facts);
  if (running_->phase == Phase::doubtful && is_step_seen()) on_accepted(now, voice, facts);
}

/// What was wished has come true since its last command was sent.
bool ModeClient::is_effect_seen() const {
  const auto& plan = running_->plan;
  const auto since = running_->step_began;
  switch (plan.wish) {
    case ModeWish::change_mode: return watch_.has_mode(plan.mode, since);
    case ModeWish::arm: return watch_.is_armed(true, since);
    case ModeWish::disarm: return watch_.is_armed(false, since);
    case ModeWish::take_off: return watch_.is_in_the_air(since);
    case ModeWish::start_mission: return watch_.is_in_the_air(since) && watch_.has_mode(plan.final_mode, since);
  }
  return false;
}

/// So has what the command of this step is to bring about.
bool ModeClient::is_step_seen() const {
  const auto since = running_->step_began;
  switch (running_->plan.steps[running_->at]) {
    case ModeStep::set_mode: return watch_.has_mode(running_->plan.mode, since);
    case ModeStep::arm: return watch_.is_armed(true, since);
    case ModeStep::disarm: return watch_.is_armed(false, since);
    case ModeStep::take_off: return watch_.is_in_the_air(since);
    case ModeStep::start_mission: return watch_.has_mode(running_->plan.final_mode, since);
  }
  return false;
}

void ModeClient::on_tick(Timestamp now, Outbox<ModeFact>& facts) {
  drain_superseded(facts);
  if (!running_ || running_->phase == Phase::asked || running_->deadline > now) return;
  if (running_->phase == Phase::accepted) return finish(Kind::no_effect, facts);
  finish(running_->answer.kind == CommandFact::Kind::refused ? Kind::refused : Kind::no_answer, facts);
}

std::optional<Timestamp> ModeClient::next_deadline() const {
  if (!superseded_.empty()) return superseded_at_;
  if (!running_ || running_->phase == Phase::asked) return std::nullopt;
  return running_->deadline;
}

void ModeClient::on_reboot(Timestamp now, Outbox<ModeFact>& facts) {
  drain_superseded(facts);
  if (running_ && running_->phase == Phase::asked) commands_.withdraw(now, running_->command);
  if (running_) finish(Kind::rebooted, facts);
  watch_.forget();
}

void ModeClient::drain_superseded(Outbox<ModeFact>& facts) {
  superseded_.drain([&](const ModeFact& each) { facts.push(each); });
}

ModeFact ModeClient::fact(Kind kind) const {
  ModeFact fact{
      .kind = kind, .request = running_->id, .wish = running_->plan.wish, .step = running_->plan.steps[running_->at]};
  if (kind != Kind::refused) return fact;
  fact.result = running_->answer.result;
  fact.reason = running_->answer.reason;
  return fact;
}

void ModeClient::finish(Kind kind, Outbox<ModeFact>& facts) {
  facts.push(fact(kind));
  running_.reset();
}

}  // namespace ponte::autopilot
