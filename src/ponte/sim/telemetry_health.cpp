#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/sim/telemetry_messages.hpp"

/// How the autopilot itself is: of a simulated one, always well.
namespace ponte::sim {

messages::PowerStatus power_status(const Snapshot& /*snapshot*/) { return {.vcc = 5000, .vservo = 0, .flags = 0}; }

messages::Meminfo meminfo(const Snapshot& /*snapshot*/) {
  constexpr std::uint32_t free_bytes = 131'072;
  return {.freemem = 65'535, .freemem32 = free_bytes};
}

messages::Ahrs ahrs(const Snapshot& /*snapshot*/) { return {.accel_weight = 0, .renorm_val = 0}; }

messages::EkfStatusReport ekf_status_report(const Snapshot& snapshot) {
  constexpr unsigned without_position =
      messages::EKF_ATTITUDE | messages::EKF_VELOCITY_VERT | messages::EKF_POS_VERT_ABS | messages::EKF_CONST_POS_MODE;
  constexpr unsigned with_position = messages::EKF_ATTITUDE | messages::EKF_VELOCITY_HORIZ |
                                     messages::EKF_VELOCITY_VERT | messages::EKF_POS_HORIZ_REL |
                                     messages::EKF_POS_HORIZ_ABS | messages::EKF_POS_VERT_ABS |
                                     messages::EKF_PRED_POS_HORIZ_REL | messages::EKF_PRED_POS_HORIZ_ABS;
  return {
      .flags = static_cast<std::uint16_t>(snapshot.has_position ? with_position : without_position),
      .velocity_variance = 0.02F,
      .pos_horiz_variance = 0.02F,
      .pos_vert_variance = 0.01F,
      .compass_variance = 0.02F,
  };
}

messages::Vibration vibration(const Snapshot& snapshot) {
  const auto shaking = static_cast<float>(snapshot.throttle);  // m/s^2: what turns shakes a little
  return {.time_usec = microseconds(snapshot.since_boot),
          .vibration_x = shaking,
          .vibration_y = shaking,
          .vibration_z = shaking};
}

}  // namespace ponte::sim
