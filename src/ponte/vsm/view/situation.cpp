#include "ponte/vsm/view/situation.hpp"

namespace ponte::vsm::view {

void append_vehicle_link(JsonText& json, const VehicleLink& link) {
  json.begin_object().member("number", link.id.value).member("endpoint", std::string_view{link.endpoint});
  json.member("state", link.is_up ? "up" : "waiting");
  if (!link.detail.empty()) json.member("detail", std::string_view{link.detail});
  json.end_object();
}

void append_situation(JsonText& json, const Situation& situation) {
  json.member("conversion", situation.converts);
  json.key("vehicle_links").begin_array();
  for (const auto& link : situation.vehicle_links) append_vehicle_link(json, link);
  json.end_array().key("dli_links").begin_array();
  for (const auto& link : situation.dli_links) json.value(std::string_view{link});
  json.end_array().key("vehicles").begin_array();
  for (const auto& vehicle : situation.vehicles) {
    json.begin_object().member("id", to_text(vehicle.id).view()).member("link", vehicle.link.value);
    json.member("system", unsigned{vehicle.system.value}).member("autopilot", unsigned{vehicle.autopilot});
    json.member("type", unsigned{vehicle.type}).member("present", vehicle.is_present).end_object();
  }
  json.end_array();
}

}  // namespace ponte::vsm::view
