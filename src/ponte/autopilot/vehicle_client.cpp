#include "ponte/autopilot/vehicle_client.hpp"

#include "ponte/autopilot/stream_requests.hpp"
#include "ponte/mavlink/autopilots/autopilot_version.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/codec.hpp"

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

/// More than one call can bring about.
constexpr std::size_t facts_of_one_call = 2 * CommandClient::capacity;

template <class Fact>
void tell(Outbox<Fact>& from, Outbox<VehicleFact>& to) {
  from.drain([&](const Fact& fact) { to.push(fact); });
}

}  // namespace

VehicleClient::VehicleClient(const Peer& peer)
    : commands_{peer},
      modes_{commands_},
      guided_{commands_, modes_},
      stream_{peer, modes_},
      gimbal_{commands_},
      camera_{commands_},
      time_sync_{peer},
      link_quality_{peer},
      health_{peer},
      missions_{peer},
      parameters_{peer},
      files_{peer},
      command_facts_{facts_of_one_call},
      mode_facts_{facts_of_one_call},
      guided_facts_{facts_of_one_call},
      stream_facts_{facts_of_one_call},
      gimbal_facts_{facts_of_one_call},
      camera_facts_{facts_of_one_call},
      mission_facts_{facts_of_one_call},
      parameter_facts_{facts_of_one_call},
      file_facts_{facts_of_one_call} {}

void VehicleClient::on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice,
                               Outbox<VehicleFact>& facts) {
  const bool is_its = frame.system == peer().system && frame.component == peer().component;
  if (is_its && mavlink::carries<messages::AutopilotVersion>(frame))
    capabilities_ = mavlink::decode<messages::AutopilotVersion>(frame).capabilities;
  link_quality_.on_message(now, frame);
  health_.on_message(now, frame);
  time_sync_.on_message(now, frame);
  commands_.on_message(now, frame, voice, command_facts_);
  modes_.on_message(now, frame, voice, mode_facts_);
  gimbal_.on_message(now, frame, voice, gimbal_facts_);
  guided_.on_tick(now, guided_facts_);
  stream_.on_tick(now, voice, stream_facts_);
  missions_.on_message(now, frame, voice, mission_facts_);
  parameters_.on_message(now, frame, voice, parameter_facts_);
  files_.on_message(now, frame, voice, file_facts_);
  pass_on(now, voice, facts);
}

void VehicleClient::on_tick(Timestamp now, Voice& voice, Outbox<VehicleFact>& facts) {
  commands_.on_tick(now, voice, command_facts_);
  stream_.on_tick(now, voice, stream_facts_);  // before the modes, which tell what it has superseded
  modes_.on_tick(now, mode_facts_);
  guided_.on_tick(now, guided_facts_);
  gimbal_.on_tick(now, gimbal_facts_);
  time_sync_.on_tick(now, voice);
  missions_.on_tick(now, voice, mission_facts_);
  parameters_.on_tick(now, voice, parameter_facts_);
  files_.on_tick(now, voice, file_facts_);
  pass_on(now, voice, facts);
}

void VehicleClient::on_streams_asked(Timestamp now) {
  for (std::size_t i = 0; i < message_rates_for(peer().stack).size(); ++i)
    commands_.on_sent_elsewhere(now, messages::MAV_CMD_SET_MESSAGE_INTERVAL);
  for (std::size_t i = 0; i < single_messages_for(peer().stack).size(); ++i)
    commands_.on_sent_elsewhere(now, messages::MAV_CMD_REQUEST_MESSAGE);
}

Timestamp VehicleClient::next_deadline() const {
  auto next = time_sync_.next_deadline();
  for (const auto& each :
       {commands_.next_deadline(), modes_.next_deadline(), guided_.next_deadline(), stream_.next_deadline(),
        gimbal_.next_deadline(), missions_.next_deadline(), parameters_.next_deadline(), files_.next_deadline()})
    if (each && *each < next) next = *each;
  return next;
}

bool VehicleClient::offers_files() const {
  const bool is_ardupilot = peer().stack == Stack::ardupilot_copter || peer().stack == Stack::ardupilot_plane;
  return is_ardupilot && (capabilities_.value_or(0) & messages::MAV_PROTOCOL_CAPABILITY_FTP) != 0;
}

void VehicleClient::on_reboot(Timestamp now, Outbox<VehicleFact>& facts) {
  capabilities_.reset();
  link_quality_.on_reboot();
  health_.on_reboot();
  time_sync_.on_reboot();
  stream_.on_reboot(now, stream_facts_);
  guided_.on_reboot(now, guided_facts_);
  gimbal_.on_reboot(now, gimbal_facts_);
  camera_.on_reboot(now, camera_facts_);
  modes_.on_reboot(now, mode_facts_);
  commands_.on_reboot(command_facts_);
  missions_.on_reboot(now);
  parameters_.on_reboot();
  files_.on_reboot(now);
  tell(command_facts_, facts);
  tell(mode_facts_, facts);
  tell_the_rest(facts);
}

/// What one service has to tell goes to the one that asked it; the rest is for the user.
void VehicleClient::pass_on(Timestamp now, Voice& voice, Outbox<VehicleFact>& facts) {
  command_facts_.drain([&](const CommandFact& fact) {
    const bool is_taken = modes_.on_answer(now, fact, voice, mode_facts_) ||
                          guided_.on_answer(now, fact, guided_facts_) || gimbal_.on_answer(now, fact, gimbal_facts_) ||
                          camera_.on_answer(now, fact, camera_facts_);
    if (!is_taken) facts.push(fact);
  });
  mode_facts_.drain([&](const ModeFact& fact) {
    if (!stream_.on_mode_fact(now, fact, stream_facts_)) facts.push(fact);
  });
  tell_the_rest(facts);
}

/// What nobody else waits for.
void VehicleClient::tell_the_rest(Outbox<VehicleFact>& facts) {
  tell(guided_facts_, facts);
  tell(stream_facts_, facts);
  tell(gimbal_facts_, facts);
  tell(camera_facts_, facts);
  tell(mission_facts_, facts);
  tell(parameter_facts_, facts);
  tell(file_facts_, facts);
}

}  // namespace ponte::autopilot
