#pragma once

#include "ponte/mavlink/autopilots/set_position_target_global_int.hpp"
#include "ponte/mavlink/autopilots/set_position_target_local_ned.hpp"
#include "ponte/sim/geodesy.hpp"
#include "ponte/sim/guided.hpp"

#include <optional>

/// What SET_POSITION_TARGET_* asks for.
namespace ponte::sim {

/// Where setpoints count from.
struct SetpointReference {
  Position origin{};    ///< of the local frame
  Position home{};      ///< of relative altitudes
  Position position{};  ///< where the vehicle knows itself to be
  Radians heading{};
};

/// Nothing if the frame is not understood, if the groups of the type mask are given in part, if a number is not finite,
/// or if neither a position nor a velocity is left. Accelerations are ignored.
[[nodiscard]] std::optional<GuidedTarget> guided_target(const mavlink::autopilots::SetPositionTargetGlobalInt& message,
                                                        const SetpointReference& reference);
[[nodiscard]] std::optional<GuidedTarget> guided_target(const mavlink::autopilots::SetPositionTargetLocalNed& message,
                                                        const SetpointReference& reference);

/// The altitude of a global frame's number, or nothing if the frame has none. The ground is as high as home.
[[nodiscard]] std::optional<Metres> altitude_in_frame(std::uint8_t frame, double altitude, const Position& home);

}  // namespace ponte::sim
