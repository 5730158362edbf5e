#include "ponte/autopilot/mission_copy.hpp"

#include "ponte/autopilot/rules.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_clear_all.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/mavlink/autopilots/mission_item.hpp"
#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/mavlink/autopilots/mission_item_reached.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

constexpr std::uint16_t last_navigation_command = messages::MAV_CMD_NAV_LAST;
constexpr std::size_t longest_jump_chain = 16;

template <mavlink::Message M>
std::optional<M> decode_if(const mavlink::FrameView& frame) {
  if (frame.message != M::info.id) return std::nullopt;
  return mavlink::decode<M>(frame);
}

/// Latitude and longitude of 0 mean "where the vehicle is" or "no position".
bool is_position(double latitude_deg, double longitude_deg) {
  return std::isfinite(latitude_deg) && std::isfinite(longitude_deg) && (latitude_deg != 0 || longitude_deg != 0) &&
         std::abs(latitude_deg) <= 90 && std::abs(longitude_deg) <= 180;
}

}  // namespace

void MissionCopy::begin_transfer(std::size_t count) {
  incoming_.clear();
  if (count <= item_limit) incoming_.resize(count);
}

void MissionCopy::take_item(std::uint16_t sequence, const Item& item) {
  if (sequence < incoming_.size()) incoming_[sequence] = item;
}

void MissionCopy::take_item_frame(const mavlink::FrameView& frame) {
  const auto place = [](Item& item, double latitude_deg, double longitude_deg) {
    if (!is_position(latitude_deg, longitude_deg)) return;
    item.latitude = radians_from_degrees(latitude_deg);
    item.longitude = radians_from_degrees(longitude_deg);
  };
  if (const auto message = decode_if<messages::MissionItemInt>(frame)) {
    if (message->mission_type != messages::MAV_MISSION_TYPE_MISSION) return;
    Item item{true, message->command, message->frame, message->param1, message->param2, {}, {}, message->z};
    place(item, message->x * 1e-7, message->y * 1e-7);
    take_item(message->seq, item);
  } else if (const auto plain = decode_if<messages::MissionItem>(frame)) {
    if (plain->mission_type != messages::MAV_MISSION_TYPE_MISSION) return;
    Item item{true, plain->command, plain->frame, plain->param1, plain->param2, {}, {}, plain->z};
    place(item, double{plain->x}, double{plain->y});
    take_item(plain->seq, item);
  }
}

void MissionCopy::commit() {
  items_ = std::move(incoming_);
  incoming_.clear();
  reached_.reset();
}

void MissionCopy::on_vehicle_message(const mavlink::FrameView& frame) {
  if (const auto current = decode_if<messages::MissionCurrent>(frame)) current_ = current->seq;
  if (const auto item = decode_if<messages::MissionItemReached>(frame)) reached_ = item->seq;
  if (const auto count = decode_if<messages::MissionCount>(frame);
      count && count->mission_type == messages::MAV_MISSION_TYPE_MISSION) {
    uploading_ = false;
    begin_transfer(count->count);
  }
  if (const auto ack = decode_if<messages::MissionAck>(frame);
      ack && ack->mission_type == messages::MAV_MISSION_TYPE_MISSION && ack->type == messages::MAV_MISSION_ACCEPTED) {
    if (clearing_) incoming_.clear();
    if (uploading_ || clearing_) commit();
    uploading_ = clearing_ = false;
  }
  if (uploading_) return;
  take_item_frame(frame);
  const bool is_complete = !incoming_.empty() && std::ranges::all_of(incoming_, &Item::known);
  if (is_complete) {
    const auto reached = reached_;  // a download does not change the mission
    commit();
    reached_ = reached;
  }
}

void MissionCopy::on_station_message(const mavlink::FrameView& frame) {
  if (const auto count = decode_if<messages::MissionCount>(frame);
      count && count->mission_type == messages::MAV_MISSION_TYPE_MISSION) {
    uploading_ = true;
    begin_transfer(count->count);
  }
  if (const auto clear = decode_if<messages::MissionClearAll>(frame);
      clear && clear->mission_type == messages::MAV_MISSION_TYPE_MISSION)
    clearing_ = true;
  if (uploading_) take_item_frame(frame);
}

const MissionCopy::Item* MissionCopy::find(std::size_t sequence) const {
  return sequence < items_.size() && items_[sequence].known ? &items_[sequence] : nullptr;
}

std::optional<std::uint16_t> MissionCopy::current_command() const {
  const auto* item = current_ ? find(*current_) : nullptr;
  if (item == nullptr) return std::nullopt;
  return item->command;
}

std::optional<vehicle::Waypoint> MissionCopy::waypoint(std::size_t sequence,
                                                       std::optional<Metres> home_altitude_msl) const {
  const auto* item = find(sequence);
  const auto number = first_item_is_home_ ? sequence : sequence + 1;
  constexpr std::size_t largest_number = 65534;
  if (item == nullptr || number == 0 || number > largest_number) return std::nullopt;
  vehicle::Waypoint waypoint{.number = static_cast<std::uint16_t>(number),
                             .latitude = item->latitude,
                             .longitude = item->longitude};
  if (!std::isfinite(item->z)) return waypoint;
  if (!home_altitude_msl && first_item_is_home_)
    if (const auto* home = find(0); home != nullptr && std::isfinite(home->z)) home_altitude_msl = Metres{home->z};
  switch (item->frame) {
    case messages::MAV_FRAME_GLOBAL:
    case messages::MAV_FRAME_GLOBAL_INT: waypoint.altitude_msl = Metres{item->z}; break;
    case messages::MAV_FRAME_GLOBAL_RELATIVE_ALT:
    case messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT:
      if (home_altitude_msl) waypoint.altitude_msl = *home_altitude_msl + Metres{item->z};
      break;
    default: break;  // above terrain, or no place at all
  }
  return waypoint;
}

/// The next item that is flown to: commands in between are passed over, jumps are followed.
std::optional<std::size_t> MissionCopy::following(std::size_t sequence) const {
  std::size_t jumps = 0;
  for (std::size_t next = sequence + 1; find(next) != nullptr;) {
    const auto& item = *find(next);
    if (item.command <= last_navigation_command) return next;
    const bool jumps_back = item.command == messages::MAV_CMD_DO_JUMP && item.param2 != 0 && item.param1 >= 0 &&
                            item.param1 < static_cast<float>(items_.size());
    if (jumps_back && ++jumps > longest_jump_chain) return std::nullopt;
    next = jumps_back ? static_cast<std::size_t>(item.param1) : next + 1;
  }
  return std::nullopt;
}

vehicle::Leg MissionCopy::leg(std::optional<Metres> home_altitude_msl) const {
  vehicle::Leg leg;
  if (reached_) leg.from = waypoint(*reached_, home_altitude_msl);
  if (!current_) return leg;
  leg.to = waypoint(*current_, home_altitude_msl);
  if (const auto next = following(*current_)) leg.next = waypoint(*next, home_altitude_msl);
  return leg;
}

}  // namespace ponte::autopilot
