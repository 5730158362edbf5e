#include "ponte/autopilot/target.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"

#include <cmath>
#include <numbers>

namespace ponte::autopilot {

namespace messages = mavlink::autopilots;

bool is_valid(const Target& target) {
  return std::abs(target.latitude.value) <= std::numbers::pi / 2 &&
         std::abs(target.longitude.value) <= std::numbers::pi && std::isfinite(target.height.value.value);
}

std::optional<Target> above_sea(const Target& target, std::optional<Metres> home_altitude_msl) {
  if (target.height.above == Height::Above::sea) return target;
  if (!home_altitude_msl) return std::nullopt;
  return Target{target.latitude, target.longitude, {*home_altitude_msl + target.height.value, Height::Above::sea}};
}

void set_place(Command& command, const Target& target) {
  const bool is_above_home = target.height.above == Height::Above::home;
  command.x = degrees_from_radians(target.latitude);
  command.y = degrees_from_radians(target.longitude);
  command.z = static_cast<float>(target.height.value.value);
  command.frame = is_above_home ? messages::MAV_FRAME_GLOBAL_RELATIVE_ALT : messages::MAV_FRAME_GLOBAL;
}

}  // namespace ponte::autopilot
