#include "ponte/autopilot/fleet_session.hpp"

#include "ponte/autopilot/stream_requests.hpp"
#include "ponte/autopilot/v09.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/request_data_stream.hpp"
#include "ponte/mavlink/autopilots/system_time.hpp"
#include "ponte/mavlink/autopilots/timesync.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/v09/attitude.hpp"
#include "ponte/mavlink/v09/enums.hpp"
#include "ponte/mavlink/v09/heartbeat.hpp"
#include "ponte/mavlink/v09/request_data_stream.hpp"

#include <algorithm>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
namespace messages_v09 = mavlink::v09;

/// Messages overtake one another by less than this; a larger step back in the time since boot is a reboot.
constexpr std::uint32_t largest_disorder_ms = 1000;
/// SYSTEM_TIME comes about once a second; a larger step forward is another clock, or a long silence.
constexpr std::uint32_t largest_jump_ms = 5000;

}  // namespace

FleetSession::FleetSession(FleetConfig config) : config_{config} {
  vehicles_.reserve(vehicle_limit);
  links_.reserve(link_limit);
}

FleetSession::Vehicle* FleetSession::find(mavlink::SystemId system) {
  const auto found = std::ranges::lower_bound(vehicles_, system, {}, &Vehicle::system);
  return found != vehicles_.end() && found->system == system ? &*found : nullptr;
}

bool FleetSession::follows(mavlink::SystemId system) const {
  return std::ranges::binary_search(vehicles_, system, {}, &Vehicle::system);
}

FleetSession::Link* FleetSession::find(LinkId link) {
  const auto found = std::ranges::find(links_, link, &Link::id);
  return found == links_.end() ? nullptr : &*found;
}

void FleetSession::on_link_up(Timestamp now, LinkId link) {
  if (find(link) != nullptr || links_.size() == link_limit) return;
  links_.push_back({.id = link, .sender = {config_.version, config_.system, config_.component}});
  next_heartbeat_ = now;  // autopilots stay silent until they hear a ground station
}

void FleetSession::on_link_down(LinkId link, Outbox<FleetFact>& facts) {
  std::erase_if(links_, [&](const Link& entry) { return entry.id == link; });
  for (auto& vehicle : vehicles_) {
    if (vehicle.link != link || vehicle.lost) continue;
    vehicle.lost = true;
    facts.push({FleetFact::Kind::lost, vehicle.system, vehicle.component, vehicle.link});
  }
}

std::optional<Voice> FleetSession::voice(LinkId link, Outbox<OutgoingFrame>& out) {
  auto* peer = find(link);
  if (peer == nullptr) return {};
  return Voice{peer->sender, link, out};
}

bool FleetSession::on_frame(Timestamp now, LinkId link, const mavlink::FrameView& frame, Outbox<OutgoingFrame>& out,
                            Outbox<FleetFact>& facts) {
  on_tick(now, out, facts);
  if (auto* peer = find(link)) note_version(*peer, frame);
  if (mavlink::carries<messages::Timesync>(frame)) answer_timesync(now, link, frame, out);
  if (const auto announcement = announcement_in(frame))
    return on_heartbeat(now, link, frame, *announcement, out, facts);

  auto* vehicle = find(frame.system);
  if (vehicle == nullptr || vehicle->link != link || vehicle->component != frame.component) return false;
  if (mavlink::carries<messages::SystemTime>(frame)) on_system_time(now, *vehicle, frame, out, facts);
  if (mavlink::carries<messages::Attitude>(frame) || mavlink::carries<messages_v09::Attitude>(frame))
    vehicle->last_attitude = now;
  return true;
}

/// We speak the version that was heard last. Who has signed a frame is spoken to in MAVLink 2 from then on: a stray
/// frame of an older version must not make us send what cannot be signed.
void FleetSession::note_version(Link& link, const mavlink::FrameView& frame) {
  link.has_signed = link.has_signed || frame.is_signed();
  link.sender.set_version(link.has_signed ? mavlink::Version::v2 : frame.version);
}

std::optional<FleetSession::Announcement> FleetSession::announcement_in(const mavlink::FrameView& frame) {
  if (mavlink::carries<messages::Heartbeat>(frame)) {
    const auto heartbeat = mavlink::decode<messages::Heartbeat>(frame);
    return Announcement{heartbeat.autopilot, heartbeat.type};
  }
  if (mavlink::carries<messages_v09::Heartbeat>(frame)) {
    const auto heartbeat = mavlink::decode<messages_v09::Heartbeat>(frame);
    return Announcement{v09::autopilot_of(heartbeat.autopilot), v09::airframe_of(heartbeat.type)};
  }
  return std::nullopt;
}

bool FleetSession::on_heartbeat(Timestamp now, LinkId link, const mavlink::FrameView& frame,
                                const Announcement& announcement, Outbox<OutgoingFrame>& out,
                                Outbox<FleetFact>& facts) {
  if (announcement.autopilot == messages::MAV_AUTOPILOT_INVALID || frame.system.value == 0) return false;
  const auto tell = [&](FleetFact::Kind kind) { facts.push({kind, frame.system, frame.component, link}); };

  auto* vehicle = find(frame.system);
  if (vehicle == nullptr) {
    if (vehicles_.size() == vehicle_limit) return false;
    const auto place = std::ranges::lower_bound(vehicles_, frame.system, {}, &Vehicle::system);
    vehicle = &*vehicles_.insert(place, Vehicle{.system = frame.system, .component = frame.component, .link = link});
    tell(FleetFact::Kind::appeared);
  } else if (vehicle->lost) {
    vehicle->lost = false;
    vehicle->link = link;
    vehicle->component = frame.component;
    vehicle->newest_boot_ms.reset();
    tell(FleetFact::Kind::returned);
  } else if (vehicle->link != link || vehicle->component != frame.component) {
    // Two that answer to one name must not be taken for one: the first stays, the other is left out and told.
    tell_duplicate(*vehicle, link, facts);
    return false;
  } else {
    vehicle->last_heartbeat = now;
    return true;
  }
  vehicle->stack = stack_of(announcement.autopilot, announcement.type);
  vehicle->type = announcement.type;
  vehicle->autopilot = announcement.autopilot;
  vehicle->last_heartbeat = now;
  ask(now, *vehicle, out);
  return true;
}

void FleetSession::tell_duplicate(Vehicle& vehicle, LinkId link, Outbox<FleetFact>& facts) {
  if (!vehicle.duplicate_told) facts.push({FleetFact::Kind::duplicate_id, vehicle.system, vehicle.component, link});
  vehicle.duplicate_told = true;
}

/// Time since boot that goes back is a reboot. If it then comes forward to where it was, it was never gone: two
/// vehicles with one id take turns on this link.
void FleetSession::on_system_time(Timestamp now, Vehicle& vehicle, const mavlink::FrameView& frame,
                                  Outbox<OutgoingFrame>& out, Outbox<FleetFact>& facts) {
  const auto boot_ms = mavlink::decode<messages::SystemTime>(frame).time_boot_ms;
  const auto before = vehicle.newest_boot_ms;
  vehicle.newest_boot_ms = boot_ms;
  if (!before) return;
  if (std::uint64_t{boot_ms} + largest_disorder_ms < *before) {
    if (vehicle.duplicate_told) return;
    vehicle.boot_ms_before_reboot = before;
    facts.push({FleetFact::Kind::rebooted, vehicle.system, vehicle.component, vehicle.link});
    ask(now, vehicle, out);
  } else if (vehicle.boot_ms_before_reboot && boot_ms >= *vehicle.boot_ms_before_reboot &&
             boot_ms > std::uint64_t{*before} + largest_jump_ms) {
    tell_duplicate(vehicle, vehicle.link, facts);
  }
}

/// A request has tc1 0; the answer mirrors ts1 and gives our time in tc1, in nanoseconds.
void FleetSession::answer_timesync(Timestamp now, LinkId link, const mavlink::FrameView& frame,
                                   Outbox<OutgoingFrame>& out) {
  const auto request = mavlink::decode<messages::Timesync>(frame);
  if (request.tc1 != 0) return;
  if (auto peer = voice(link, out))
    peer->send(messages::Timesync{.tc1 = now.time_since_epoch().count(),
                                  .ts1 = request.ts1,
                                  .target_system = frame.system.value,
                                  .target_component = frame.component.value});
}

void FleetSession::ask(Timestamp now, Vehicle& vehicle, Outbox<OutgoingFrame>& out) {
  vehicle.last_request = now;
  vehicle.last_attitude = now;
  auto peer = voice(vehicle.link, out);
  if (!config_.ask_for_streams || !peer) return;
  if (peer->version() == mavlink::Version::v0_9) return ask_v09(vehicle, *peer);
  for (const auto& group : stream_groups_for(vehicle.stack))
    peer->send(messages::RequestDataStream{.target_system = vehicle.system.value,
                                           .target_component = vehicle.component.value,
                                           .req_stream_id = group.group,
                                           .req_message_rate = group.rate_hz,
                                           .start_stop = 1});
  const auto command = [&](std::uint16_t number, mavlink::MessageId message, float parameter) {
    peer->send(messages::CommandLong{.target_system = vehicle.system.value,
                                     .target_component = vehicle.component.value,
                                     .command = number,
                                     .param1 = static_cast<float>(message.value),
                                     .param2 = parameter});
  };
  constexpr double us_per_s = 1e6;
  for (const auto& [message, rate_hz] : message_rates_for(vehicle.stack))
    command(messages::MAV_CMD_SET_MESSAGE_INTERVAL, message, static_cast<float>(us_per_s / rate_hz));
  for (const auto message : single_messages_for(vehicle.stack)) command(messages::MAV_CMD_REQUEST_MESSAGE, message, 0);
}

/// Streams are all that can be asked for in MAVLink 0.9. Their numbers are those of ArduPilot until today.
void FleetSession::ask_v09(const Vehicle& vehicle, Voice& peer) {
  for (const auto& group : stream_groups_for(Stack::ardupilot_copter))
    peer.send(messages_v09::RequestDataStream{.target_system = vehicle.system.value,
                                              .target_component = vehicle.component.value,
                                              .req_stream_id = group.group,
                                              .req_message_rate = group.rate_hz,
                                              .start_stop = 1});
}

void FleetSession::send_heartbeat(Voice peer) {
  if (peer.version() == mavlink::Version::v0_9)
    peer.send(messages_v09::Heartbeat{.type = messages_v09::OCU, .autopilot = messages_v09::MAV_AUTOPILOT_NONE});
  else
    peer.send(messages::Heartbeat{.type = messages::MAV_TYPE_GCS,
                                  .autopilot = messages::MAV_AUTOPILOT_INVALID,
                                  .system_status = messages::MAV_STATE_ACTIVE});
}

void FleetSession::on_tick(Timestamp now, Outbox<OutgoingFrame>& out, Outbox<FleetFact>& facts) {
  if (next_heartbeat_ && *next_heartbeat_ <= now) {
    for (auto& link : links_) send_heartbeat({link.sender, link.id, out});
    next_heartbeat_ = now + heartbeat_period;
  }
  for (auto& vehicle : vehicles_) {
    if (vehicle.lost) continue;
    if (now - vehicle.last_heartbeat >= loss_limit) {
      vehicle.lost = true;
      facts.push({FleetFact::Kind::lost, vehicle.system, vehicle.component, vehicle.link});
      continue;
    }
    if (now - vehicle.last_attitude >= stream_patience && now - vehicle.last_request >= stream_patience)
      ask(now, vehicle, out);
  }
}

std::optional<Timestamp> FleetSession::next_deadline() const {
  auto deadline = next_heartbeat_;
  const auto consider = [&](Timestamp time) { deadline = deadline ? std::min(*deadline, time) : time; };
  for (const auto& vehicle : vehicles_) {
    if (vehicle.lost) continue;
    consider(vehicle.last_heartbeat + loss_limit);
    consider(std::max(vehicle.last_attitude, vehicle.last_request) + stream_patience);
  }
  return deadline;
}

}  // namespace ponte::autopilot
