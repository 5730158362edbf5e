#include "ponte/sim/gimbal.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/sim/airframe.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::sim {

namespace messages = mavlink::autopilots;

namespace {

constexpr double fastest = 1.5;  // rad/s
constexpr double step_seconds = std::chrono::duration<double>(Airframe::step_length).count();

/// The angle after one step towards `wanted`.
double approached(double angle, double wanted) {
  constexpr double reach = fastest * step_seconds;
  return angle + std::clamp(wanted - angle, -reach, reach);
}

/// Where this rate takes the angle in one step.
Radians turned_on(Radians angle, double rate) {
  return Radians{angle.value + std::clamp(rate, -fastest, fastest) * step_seconds};
}

}  // namespace

void Gimbal::point(float pitch, float yaw, float pitch_rate, float yaw_rate, std::uint32_t flags) {
  place_.reset();
  const bool ahead = (flags & (messages::GIMBAL_MANAGER_FLAGS_RETRACT | messages::GIMBAL_MANAGER_FLAGS_NEUTRAL)) != 0;
  if (ahead) pitch = yaw = 0;
  const bool in_earth_frame = (flags & messages::GIMBAL_MANAGER_FLAGS_YAW_IN_EARTH_FRAME) != 0;
  const bool in_vehicle_frame = (flags & messages::GIMBAL_MANAGER_FLAGS_YAW_IN_VEHICLE_FRAME) != 0;
  const bool is_locked = (flags & messages::GIMBAL_MANAGER_FLAGS_YAW_LOCK) != 0;
  yaw_is_locked_ = !ahead && (in_earth_frame || (is_locked && !in_vehicle_frame));
  if (std::isfinite(pitch)) wanted_pitch_ = Radians{pitch};
  if (std::isfinite(yaw)) wanted_yaw_ = Radians{wrapped(double{yaw})};
  pitch_rate_ = std::isfinite(pitch) || !std::isfinite(pitch_rate) ? 0 : double{pitch_rate};
  yaw_rate_ = std::isfinite(yaw) || !std::isfinite(yaw_rate) ? 0 : double{yaw_rate};
}

void Gimbal::look_at(const std::optional<Position>& place) {
  point(0, 0, 0, 0, 0);
  place_ = place;
}

void Gimbal::configure(float system, float component, Requester sender) {
  constexpr float for_the_sender = -2;
  constexpr float gives_up = -3;
  if (system == for_the_sender) {
    state_.controller = sender;
  } else if (system == gives_up) {
    if (state_.controller == sender) state_.controller = {};
  } else if (system >= 0 && system <= 255 && component >= 0 && component <= 255) {
    state_.controller = {mavlink::SystemId{static_cast<std::uint8_t>(system)},
                         mavlink::ComponentId{static_cast<std::uint8_t>(component)}};
  }
}

void Gimbal::step(const Position& position, const Attitude& vehicle, const std::optional<Position>& place) {
  if (const auto& target = place ? place : place_) {
    const auto offset = offset_between(position, *target);
    wanted_pitch_ = Radians{std::atan2(-offset.down, horizontal(offset))};
    wanted_yaw_ = Radians{std::atan2(offset.east, offset.north)};
    yaw_is_locked_ = true;
  }
  wanted_pitch_ = turned_on(wanted_pitch_, pitch_rate_);
  wanted_yaw_ = turned_on(wanted_yaw_, yaw_rate_);
  wanted_pitch_ = Radians{std::clamp(wanted_pitch_.value, lowest.value, highest.value)};

  const double from_nose = wrapped(wanted_yaw_.value - (yaw_is_locked_ ? vehicle.heading.value : 0));
  const double pitch = approached(state_.pitch.value, wanted_pitch_.value);
  const double yaw = approached(state_.yaw.value, from_nose);
  state_.pitch_rate = RadiansPerSecond{(pitch - state_.pitch.value) / step_seconds};
  state_.yaw_rate = RadiansPerSecond{(yaw - state_.yaw.value) / step_seconds};
  state_.pitch = Radians{pitch};
  state_.yaw = Radians{yaw};
  state_.heading = vehicle.heading;
  state_.flags = static_cast<std::uint16_t>(
      messages::GIMBAL_DEVICE_FLAGS_ROLL_LOCK | messages::GIMBAL_DEVICE_FLAGS_PITCH_LOCK |
      (yaw_is_locked_ ? messages::GIMBAL_DEVICE_FLAGS_YAW_LOCK | messages::GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME
                      : messages::GIMBAL_DEVICE_FLAGS_YAW_IN_VEHICLE_FRAME));
}

}  // namespace ponte::sim
