#include "ponte/sim/setpoint.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <cmath>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

// POSITION_TARGET_TYPEMASK: what is to be ignored.
constexpr unsigned no_position = 7;
constexpr unsigned no_velocity = 7U << 3;
constexpr unsigned no_yaw = messages::POSITION_TARGET_TYPEMASK_YAW_IGNORE;
constexpr unsigned no_yaw_rate = messages::POSITION_TARGET_TYPEMASK_YAW_RATE_IGNORE;

/// A group of three is given as a whole or not at all.
bool is_split(unsigned mask, unsigned group) { return (mask & group) != 0 && (mask & group) != group; }

NorthEastDown turned(const NorthEastDown& forward, double heading) {
  return {forward.north * std::cos(heading) - forward.east * std::sin(heading),
          forward.north * std::sin(heading) + forward.east * std::cos(heading), forward.down};
}

bool is_finite(const NorthEastDown& vector) {
  return std::isfinite(vector.north) && std::isfinite(vector.east) && std::isfinite(vector.down);
}

/// Velocity, heading and turn rate, which all frames have in common. False: not to be taken.
template <class M>
bool take_motion(const M& message, const SetpointReference& reference, bool along_body, GuidedTarget& target) {
  const unsigned mask = message.type_mask;
  if (is_split(mask, no_position) || is_split(mask, no_velocity)) return false;
  if ((mask & no_velocity) == 0) {
    const NorthEastDown velocity{message.vx, message.vy, message.vz};
    if (!is_finite(velocity)) return false;
    target.velocity = along_body ? turned(velocity, reference.heading.value) : velocity;
  }
  if ((mask & no_yaw) == 0 && std::isfinite(message.yaw))
    target.heading = Radians{message.yaw + (along_body ? reference.heading.value : 0)};
  if ((mask & no_yaw_rate) == 0 && std::isfinite(message.yaw_rate))
    target.turn_rate = RadiansPerSecond{message.yaw_rate};
  return true;
}

std::optional<GuidedTarget> if_any(const GuidedTarget& target) {
  if (!target.position && !target.velocity) return std::nullopt;
  return target;
}

}  // namespace

std::optional<Metres> altitude_in_frame(std::uint8_t frame, double altitude, const Position& home) {
  switch (frame) {
    case messages::MAV_FRAME_GLOBAL:
    case messages::MAV_FRAME_GLOBAL_INT: return Metres{altitude};
    case messages::MAV_FRAME_GLOBAL_RELATIVE_ALT:
    case messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT:
    case messages::MAV_FRAME_GLOBAL_TERRAIN_ALT:
    case messages::MAV_FRAME_GLOBAL_TERRAIN_ALT_INT: return home.altitude_msl + Metres{altitude};
    default: return std::nullopt;
  }
}

std::optional<GuidedTarget> guided_target(const messages::SetPositionTargetGlobalInt& message,
                                          const SetpointReference& reference) {
  const auto altitude = altitude_in_frame(message.coordinate_frame, double{message.alt}, reference.home);
  GuidedTarget target;
  if (!altitude || !take_motion(message, reference, false, target)) return std::nullopt;
  if ((message.type_mask & no_position) == 0) {
    constexpr double degrees = 1e-7;
    if (!std::isfinite(message.alt) || std::abs(message.lat_int * degrees) > 90) return std::nullopt;
    target.position = Position{radians_from_degrees(message.lat_int * degrees),
                               radians_from_degrees(message.lon_int * degrees), *altitude};
  }
  return if_any(target);
}

std::optional<GuidedTarget> guided_target(const messages::SetPositionTargetLocalNed& message,
                                          const SetpointReference& reference) {
  const auto frame = message.coordinate_frame;
  const bool along_body = frame == messages::MAV_FRAME_BODY_NED || frame == messages::MAV_FRAME_BODY_OFFSET_NED ||
                          frame == messages::MAV_FRAME_BODY_FRD;
  const bool is_offset = along_body || frame == messages::MAV_FRAME_LOCAL_OFFSET_NED;
  if (!is_offset && frame != messages::MAV_FRAME_LOCAL_NED) return std::nullopt;
  GuidedTarget target;
  if (!take_motion(message, reference, along_body, target)) return std::nullopt;
  if ((message.type_mask & no_position) == 0) {
    const NorthEastDown given{message.x, message.y, message.z};
    constexpr double farthest = 100'000;  // m: the local frame is flat
    if (!is_finite(given) || horizontal(given) > farthest || std::abs(given.down) > farthest) return std::nullopt;
    const auto offset = along_body ? turned(given, reference.heading.value) : given;
    target.position = displaced(is_offset ? reference.position : reference.origin, offset);
  }
  return if_any(target);
}

}  // namespace ponte::sim
