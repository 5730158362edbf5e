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
    : commands_{peer}, modes_{commands_}, command_facts_{facts_of_one_call}, mode_facts_{facts_of_one_call} {}

void VehicleClient::on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice,
                               Outbox<VehicleFact>& facts) {
  commands_.on_message(now, frame, voice, command_facts_);
  pass_on(now, voice, facts);
  modes_.on_message(now, frame, voice, mode_facts_);
  tell(mode_facts_, facts);
}

void VehicleClient::on_tick(Timestamp now, Voice& voice, Outbox<VehicleFact>& facts) {
  commands_.on_tick(now, voice, command_facts_);
  pass_on(now, voice, facts);
  modes_.on_tick(now, mode_facts_);
  tell(mode_facts_, facts);
}

std::optional<Timestamp> VehicleClient::next_deadline() const {
  std::optional<Timestamp> next;
  for (const auto& each : {commands_.next_deadline(), modes_.next_deadline()})
    if (each && (!next || *each < *next)) next = each;
  return next;
}

void VehicleClient::on_reboot(Timestamp now, Outbox<VehicleFact>& facts) {
  modes_.on_reboot(now, mode_facts_);
  tell(mode_facts_, facts);
  commands_.on_reboot(command_facts_);
  tell(command_facts_, facts);
}

/// What the commands have to tell, to the service that asked; the rest to the user.
void VehicleClient::pass_on(Timestamp now, Voice& voice, Outbox<VehicleFact>& facts) {
  command_facts_.drain([&](const CommandFact& fact) {
    if (!modes_.on_answer(now, fact, voice, mode_facts_)) facts.push(fact);
  });
}

}  // namespace ponte::autopilot
