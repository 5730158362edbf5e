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

#include <cmath>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

constexpr std::uint16_t last_navigation_command = messages::MAV_CMD_NAV_LAST;
constexpr std::size_t longest_jump_chain = 16;

template <mavlink::Message M>
std::optional<M> decode_if(const mavlink::FrameView& frame) {
  if (!mavlink::carries<M>(frame)) return std::nullopt;
  return mavlink::decode<M>(frame);
}

/// Latitude and longitude of 0 mean "where the vehicle is" or "no position".
bool is_position(double latitude_deg, double longitude_deg) {
  return std::isfinite(latitude_deg) && std::isfinite(longitude_deg) && (latitude_deg != 0 || longitude_deg != 0) &&
         std::abs(latitude_deg) <= 90 && std::abs(longitude_deg) <= 180;
}

/// True for the frames in which x and y are latitude and longitude.
bool is_global(std::uint8_t frame) {
  switch (frame) {
    case messages::MAV_FRAME_GLOBAL:
    case messages::MAV_FRAME_GLOBAL_INT:
    case messages::MAV_FRAME_GLOBAL_RELATIVE_ALT:
    case messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT:
    case messages::MAV_FRAME_GLOBAL_TERRAIN_ALT:
    case messages::MAV_FRAME_GLOBAL_TERRAIN_ALT_INT: return true;
    default: return false;
  }
}

/// Items that are flown to a height, even where they name no place.
bool is_take_off(std::uint16_t command) {
  return command == messages::MAV_CMD_NAV_TAKEOFF || command == messages::MAV_CMD_NAV_VTOL_TAKEOFF;
}

/// MAVLink 1 knows no mission types and means the mission.
template <class M>
bool is_of_mission(const M& message) {
  return message.mission_type == messages::MAV_MISSION_TYPE_MISSION;
}

}  // namespace

std::optional<MissionCopy::NumberedItem> MissionCopy::item_in(const mavlink::FrameView& frame) {
  const auto item_of = [](const auto& message, double latitude_deg, double longitude_deg) {
    NumberedItem result{message.seq,
                        {true, message.command, message.frame, message.param1, message.param2, {}, {}, message.z}};
    if (is_global(message.frame) && is_position(latitude_deg, longitude_deg)) {
      result.item.latitude = radians_from_degrees(latitude_deg);
      result.item.longitude = radians_from_degrees(longitude_deg);
    }
    return result;
  };
  if (const auto item = decode_if<messages::MissionItemInt>(frame); item && is_of_mission(*item))
    return item_of(*item, item->x * 1e-7, item->y * 1e-7);
  if (const auto item = decode_if<messages::MissionItem>(frame); item && is_of_mission(*item))
    return item_of(*item, double{item->x}, double{item->y});
  return std::nullopt;
}

/// What the vehicle tells of its mission is so, whether all of it is asked for or a single item.
void MissionCopy::on_vehicle_message(const mavlink::FrameView& frame) {
  if (const auto current = decode_if<messages::MissionCurrent>(frame)) current_ = current->seq;
  if (const auto item = decode_if<messages::MissionItemReached>(frame)) reached_ = item->seq;
  if (const auto count = decode_if<messages::MissionCount>(frame); count && is_of_mission(*count)) {
    // Another count than ours: we have missed an upload, and what we know is of an old mission.
    if (count->count != items_.size()) items_.assign(count->count <= item_limit ? count->count : 0, Item{});
  }
  if (const auto told = item_in(frame); told && told->sequence < items_.size()) items_[told->sequence] = told->item;
  if (const auto ack = decode_if<messages::MissionAck>(frame)) on_answer(ack->type, ack->mission_type);
}

void MissionCopy::on_answer(std::uint8_t result, std::uint8_t mission_type) {
  const bool clears = clearing_ && (mission_type == messages::MAV_MISSION_TYPE_MISSION ||
                                    mission_type == messages::MAV_MISSION_TYPE_ALL);
  if (!clears && mission_type != messages::MAV_MISSION_TYPE_MISSION) return;
  // The upload goes on after this one.
  if (result == messages::MAV_MISSION_INVALID_SEQUENCE) return;

  if (result == messages::MAV_MISSION_ACCEPTED && clears) {
    items_.clear();
    reached_.reset();
  } else if (result == messages::MAV_MISSION_ACCEPTED && uploading_) {
    // ArduPilot replaces the home item by its own home.
    if (first_item_is_home_ && !incoming_.empty()) incoming_.front() = items_.empty() ? Item{} : items_.front();
    items_ = std::move(incoming_);
    reached_.reset();
  } else if (uploading_ && first_item_is_home_) {
    items_.clear();  // ArduPilot overwrites item by item: nobody knows how far it came. PX4 keeps the old mission.
  }
  incoming_.clear();
  uploading_ = clearing_ = false;
}

void MissionCopy::on_station_message(const mavlink::FrameView& frame) {
  if (const auto count = decode_if<messages::MissionCount>(frame); count && is_of_mission(*count)) {
    uploading_ = true;
    clearing_ = false;
    incoming_.assign(count->count <= item_limit ? count->count : 0, Item{});
  }
  if (const auto clear = decode_if<messages::MissionClearAll>(frame);
      clear && (is_of_mission(*clear) || clear->mission_type == messages::MAV_MISSION_TYPE_ALL))
    clearing_ = true;
  if (const auto sent = item_in(frame); sent && sent->sequence < incoming_.size())
    incoming_[sent->sequence] = sent->item;
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
  vehicle::Waypoint waypoint{
      .number = static_cast<std::uint16_t>(number), .latitude = item->latitude, .longitude = item->longitude};
  // Without a place, e.g. in NAV_RETURN_TO_LAUNCH, the height means nothing.
  if (!std::isfinite(item->z) || !(item->latitude || is_take_off(item->command))) return waypoint;
  if (!home_altitude_msl && first_item_is_home_)
    if (const auto* home = find(0); home != nullptr && home->latitude && std::isfinite(home->z))
      home_altitude_msl = Metres{home->z};
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
  std::size_t jump_count = 0;
  for (std::size_t next = sequence + 1; find(next) != nullptr;) {
    const auto& item = *find(next);
    if (item.command <= last_navigation_command) return next;
    const bool jumps = item.command == messages::MAV_CMD_DO_JUMP && item.param2 != 0 && item.param1 >= 0 &&
                       item.param1 < static_cast<float>(items_.size());
    if (jumps && ++jump_count > longest_jump_chain) return std::nullopt;
    next = jumps ? static_cast<std::size_t>(item.param1) : next + 1;
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
