#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/dli/entity_id.hpp"
#include "ponte/mavlink/message_info.hpp"
#include "ponte/vsm/crossing.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace ponte::vsm::view {

/// An endpoint of vehicles, as it is now.
struct VehicleLink {
  VehicleLinkId id{};
  std::string endpoint{};
  bool is_up{};          ///< somebody can be heard on it
  std::string detail{};  ///< why it is not up, where there is a reason

  friend bool operator==(const VehicleLink&, const VehicleLink&) = default;
};

struct VehicleOnLink {
  dli::EntityId id{};
  VehicleLinkId link{};
  mavlink::SystemId system{};
  std::uint8_t autopilot{};  ///< MAV_AUTOPILOT
  std::uint8_t type{};       ///< MAV_TYPE
  bool is_present{};

  friend bool operator==(const VehicleOnLink&, const VehicleOnLink&) = default;
};

/// What a VSM is doing, but for numbers that count.
struct Situation {
  bool converts{};
  std::vector<VehicleLink> vehicle_links{};
  std::vector<std::string> dli_links{};
  std::vector<VehicleOnLink> vehicles{};

  friend bool operator==(const Situation&, const Situation&) = default;
};

/// The object VehicleLink of web/contract/messages.schema.json.
void append_vehicle_link(JsonText& json, const VehicleLink& link);
/// The members conversion, vehicle_links, dli_links and vehicles of its Status, to an object that has begun.
void append_situation(JsonText& json, const Situation& situation);

}  // namespace ponte::vsm::view
