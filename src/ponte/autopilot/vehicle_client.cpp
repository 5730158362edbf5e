#include "ponte/autopilot/vehicle_client.hpp"

namespace ponte::autopilot {
namespace {

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
      missions_{peer},
      parameters_{peer},
      files_{peer},
      command_facts_{facts_of_one_call},
      mode_facts_{facts_of_one_call},
      guided_facts_{facts_of_one_call},
      stream_facts_{facts_of_one_call},
      mission_facts_{facts_of_one_call},
      parameter_facts_{facts_of_one_call},
      file_facts_{facts_of_one_call} {}

void VehicleClient::on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice,
                               Outbox<VehicleFact>& facts) {
  commands_.on_message(now, frame, voice, command_facts_);
  modes_.on_message(now, frame, voice, mode_facts_);
  guided_.on_tick(now, guided_facts_);
  stream_.on_tick(now, voice, stream_facts_);
  missions_.on_message(now, frame, voice, mission_facts_);
  parameters_.on_message(now, frame, voice, parameter_facts_);
  files_.on_message(now, frame, voice, file_facts_);
  pass_on(now, voice, facts);
}

void VehicleClient::on_tick(Timestamp now, Voice& voice, Outbox<VehicleFact>& facts) {
  commands_.on_tick(now, voice, command_facts_);
  modes_.on_tick(now, mode_facts_);
  guided_.on_tick(now, guided_facts_);
  stream_.on_tick(now, voice, stream_facts_);
  missions_.on_tick(now, voice, mission_facts_);
  parameters_.on_tick(now, voice, parameter_facts_);
  files_.on_tick(now, voice, file_facts_);
  pass_on(now, voice, facts);
}

std::optional<Timestamp> VehicleClient::next_deadline() const {
  std::optional<Timestamp> next;
  for (const auto& each :
       {commands_.next_deadline(), modes_.next_deadline(), guided_.next_deadline(), stream_.next_deadline(),
        missions_.next_deadline(), parameters_.next_deadline(), files_.next_deadline()})
    if (each && (!next || *each < *next)) next = each;
  return next;
}

void VehicleClient::on_reboot(Timestamp now, Outbox<VehicleFact>& facts) {
  stream_.on_reboot(stream_facts_);
  guided_.on_reboot(now, guided_facts_);
  modes_.on_reboot(now, mode_facts_);
  commands_.on_reboot(command_facts_);
  missions_.on_reboot(now);
  parameters_.on_reboot();
  files_.on_reboot(now);
  tell(command_facts_, facts);
  tell(mode_facts_, facts);
  tell(guided_facts_, facts);
  tell(stream_facts_, facts);
}

/// What one service has to tell goes to the one that asked it; the rest is for the user.
void VehicleClient::pass_on(Timestamp now, Voice& voice, Outbox<VehicleFact>& facts) {
  command_facts_.drain([&](const CommandFact& fact) {
    const bool is_taken =
        modes_.on_answer(now, fact, voice, mode_facts_) || guided_.on_answer(now, fact, guided_facts_);
    if (!is_taken) facts.push(fact);
  });
  mode_facts_.drain([&](const ModeFact& fact) {
    if (!stream_.on_mode_fact(now, fact, stream_facts_)) facts.push(fact);
  });
  tell(guided_facts_, facts);
  tell(stream_facts_, facts);
  tell(mission_facts_, facts);
  tell(parameter_facts_, facts);
  tell(file_facts_, facts);
}

}  // namespace ponte::autopilot
