#include "support/world/pilot.hpp"

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/command_ack.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_request.hpp"
#include "ponte/mavlink/autopilots/mission_request_int.hpp"
#include "ponte/mavlink/autopilots/mission_request_list.hpp"
#include "ponte/mavlink/codec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ponte::world {

namespace messages = mavlink::autopilots;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr Duration heartbeat_period = seconds{1};
constexpr Duration patience = milliseconds{1500};
constexpr Duration longest_delay = seconds{2};      // of a message, on the worst radio
constexpr std::uint8_t most_attempts_to_arm = 100;  // something is wrong with the vehicle

/// Two numbers mean the same frame, and each autopilot gives back its own.
std::uint8_t one_frame(std::uint8_t frame) {
  return frame == messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT ? std::uint8_t{messages::MAV_FRAME_GLOBAL_RELATIVE_ALT}
                                                              : frame;
}

/// As far as an autopilot keeps it: ArduPilot stores whole centimetres.
bool is_same(const MissionItem& sent, const MissionItem& stored) {
  constexpr float centimetre = 0.011F;
  const auto told = [](const MissionItem& item) {
    return std::tuple{one_frame(item.frame), item.command, item.param1, item.param2, item.param3, item.x, item.y};
  };
  return told(sent) == told(stored) && std::abs(sent.z - stored.z) < centimetre;
}

}  // namespace

Pilot::Pilot(PilotConfig config) : config_{std::move(config)}, parser_{autopilot::dialect} {}

std::optional<Timestamp> Pilot::next_deadline() const { return std::min(next_heartbeat_, next_try_); }

void Pilot::on_piece(Timestamp now, Port /*port*/, Bytes piece, Sender& out) {
  now_ = now;
  out_ = &out;
  parser_.on_bytes(now, piece, *this);
}

void Pilot::on_tick(Timestamp now, Sender& out) {
  now_ = now;
  out_ = &out;
  if (next_heartbeat_ <= now) {
    next_heartbeat_ = now + heartbeat_period;
    send(messages::Heartbeat{.type = messages::MAV_TYPE_GCS,
                             .autopilot = messages::MAV_AUTOPILOT_INVALID,
                             .system_status = messages::MAV_STATE_ACTIVE,
                             .mavlink_version = 3});
  }
  if (next_try_ <= now) act();
}

void Pilot::go_on_to(Phase phase) {
  phase_ = phase;
  wanted_item_.reset();
  confirmation_ = 0;
  read_back_.clear();
  out_->tell(name_of(phase));
  act();
}

/// What the phase asks for, said again and again until it is answered.
void Pilot::act() {
  next_try_ = now_ + patience;
  const auto target = config_.vehicle.value;
  const auto count = static_cast<std::uint16_t>(config_.mission.size());
  switch (phase_) {
    case Phase::uploading:
      if (wanted_item_) return send(config_.mission[*wanted_item_]);
      return send(messages::MissionCount{.target_system = target, .target_component = 1, .count = count});
    case Phase::reading_back:
      if (!wanted_item_) return send(messages::MissionRequestList{.target_system = target, .target_component = 1});
      return send(messages::MissionRequestInt{.target_system = target, .target_component = 1, .seq = *wanted_item_});
    case Phase::choosing_mode:
      if (config_.kind.personality == sim::Personality::px4) return command(messages::MAV_CMD_DO_SET_MODE, {1, 4, 4});
      return command(messages::MAV_CMD_DO_SET_MODE, {1, is_plane() ? 10.0F : 4.0F, 0});  // AUTO or GUIDED
    case Phase::arming:
      if (confirmation_ == most_attempts_to_arm) return go_on_to(Phase::refused);
      return command(messages::MAV_CMD_COMPONENT_ARM_DISARM, {1, 0, 0});
    case Phase::starting: return command(messages::MAV_CMD_MISSION_START, {});
    case Phase::looking:
    case Phase::flying:
    case Phase::done:
    case Phase::refused: next_try_ = Timestamp::max(); return;
  }
}

void Pilot::on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
  if (message == nullptr || frame.system != config_.vehicle) return;
  switch (frame.message.value) {
    case messages::Heartbeat::info.id.value: return on_heartbeat(frame);
    case messages::MissionRequest::info.id.value:
      return on_mission_request(mavlink::decode<messages::MissionRequest>(frame).seq);
    case messages::MissionRequestInt::info.id.value:
      return on_mission_request(mavlink::decode<messages::MissionRequestInt>(frame).seq);
    case messages::MissionAck::info.id.value: return on_mission_ack(mavlink::decode<messages::MissionAck>(frame).type);
    case messages::MissionCount::info.id.value:
      if (phase_ != Phase::reading_back || wanted_item_) return;
      if (const auto count = mavlink::decode<messages::MissionCount>(frame).count; count != config_.mission.size())
        difference_ = fmt::format("{} items instead of {}", count, config_.mission.size());
      wanted_item_ = 0;
      return act();
    case MissionItem::info.id.value: return on_mission_item(mavlink::decode<MissionItem>(frame));
    case messages::CommandAck::info.id.value: return on_command_ack(frame);
    default: return;
  }
}

void Pilot::on_heartbeat(const mavlink::FrameView& frame) {
  is_armed_ = (mavlink::decode<messages::Heartbeat>(frame).base_mode & messages::MAV_MODE_FLAG_SAFETY_ARMED) != 0;
  if (phase_ == Phase::looking) return go_on_to(Phase::uploading);
  if (phase_ != Phase::starting && phase_ != Phase::flying) return;
  // A vehicle that is not started in time has disarmed itself, perhaps unheard.
  const bool is_news = now_ - *started_ >= longest_delay;
  if (is_news && !is_armed_) go_on_to(phase_ == Phase::starting ? Phase::choosing_mode : Phase::done);
}

void Pilot::on_mission_request(std::uint16_t sequence) {
  if (phase_ != Phase::uploading || sequence >= config_.mission.size()) return;
  wanted_item_ = sequence;
  act();
}

void Pilot::on_mission_ack(std::uint8_t type) {
  if (phase_ != Phase::uploading) return;
  if (type == messages::MAV_MISSION_ACCEPTED) return go_on_to(Phase::reading_back);
  if (type == messages::MAV_MISSION_INVALID_SEQUENCE) return;  // about an item that came twice
  wanted_item_.reset();                                        // from the beginning, in a while
}

void Pilot::on_mission_item(const MissionItem& item) {
  if (phase_ != Phase::reading_back || !wanted_item_ || item.seq != *wanted_item_) return;
  // ArduPilot keeps its home in the first.
  const bool is_home = config_.kind.personality == sim::Personality::ardupilot && item.seq == 0;
  if (!is_home && !is_same(config_.mission[item.seq], item)) difference_ = fmt::format("item {} differs", item.seq);
  if (++*wanted_item_ < config_.mission.size()) return act();
  send(messages::MissionAck{.target_system = config_.vehicle.value, .target_component = 1});
  go_on_to(Phase::choosing_mode);
}

void Pilot::on_command_ack(const mavlink::FrameView& frame) {
  const auto ack = mavlink::decode<messages::CommandAck>(frame);
  if (ack.result != messages::MAV_RESULT_ACCEPTED) return;  // it is said again in a while
  if (phase_ == Phase::choosing_mode && ack.command == messages::MAV_CMD_DO_SET_MODE) return go_on_to(Phase::arming);
  if (phase_ == Phase::arming && ack.command == messages::MAV_CMD_COMPONENT_ARM_DISARM) {
    started_ = now_;
    const bool starts_by_itself = is_plane() || config_.kind.personality == sim::Personality::px4;
    return go_on_to(starts_by_itself ? Phase::flying : Phase::starting);
  }
  if (phase_ == Phase::starting && ack.command == messages::MAV_CMD_MISSION_START) go_on_to(Phase::flying);
}

void Pilot::command(std::uint16_t number, const std::array<float, 3>& parameters) {
  send(messages::CommandLong{.target_system = config_.vehicle.value,
                             .target_component = 1,
                             .command = number,
                             .confirmation = confirmation_++,
                             .param1 = parameters[0],
                             .param2 = parameters[1],
                             .param3 = parameters[2]});
}

template <mavlink::Message M>
void Pilot::send(const M& message) {
  std::array<std::byte, mavlink::max_frame_size> buffer{};
  const mavlink::FrameHeader header{
      .system = mavlink::SystemId{255}, .component = mavlink::ComponentId{190}, .sequence = sequence_++};
  out_->send_to_all(Bytes{buffer}.first(mavlink::encode(message, header, buffer).value()));
}

std::string_view name_of(Pilot::Phase phase) {
  using Phase = Pilot::Phase;
  switch (phase) {
    case Phase::looking: return "looking for the vehicle";
    case Phase::uploading: return "uploading the mission";
    case Phase::reading_back: return "reading the mission back";
    case Phase::choosing_mode: return "choosing the mode";
    case Phase::arming: return "arming";
    case Phase::starting: return "starting the mission";
    case Phase::flying: return "flying";
    case Phase::done: return "done";
    case Phase::refused: return "given up, as the vehicle does not arm";
  }
  return {};
}

}  // namespace ponte::world
