#include "ponte/vehicle/mission_command.hpp"

#include "ponte/core/degrees.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ponte::vehicle {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint8_t frame_mission = 2;

/// MAV_CMD.
enum Command : std::uint16_t {
  nav_waypoint = 16,
  nav_loiter_unlim = 17,
  nav_loiter_turns = 18,
  nav_loiter_time = 19,
  nav_return_to_launch = 20,
  nav_land = 21,
  nav_takeoff = 22,
  nav_delay = 93,
  do_jump = 177,
  do_change_speed = 178,
  do_set_roi_location = 195,
  do_set_roi_none = 197,
  do_mount_control = 205,
  do_set_cam_trigg_dist = 206,
  image_start_capture = 2000,
  image_stop_capture = 2001,
};

constexpr double mount_by_angles = 2;  ///< MAV_MOUNT_MODE_MAVLINK_TARGETING
constexpr double unchanged = -1;
constexpr double for_ever = -1;

// Reading parameters.

bool is_nothing(double parameter) { return parameter == 0 || std::isnan(parameter); }

double or_zero(double parameter) { return std::isnan(parameter) ? 0 : parameter; }

std::optional<Radians> angle_in(double parameter) {
  if (std::isnan(parameter)) return std::nullopt;
  return radians_from_degrees(parameter);
}

std::optional<Place> place_in(const MissionCommand& command) {
  const double latitude = command.parameters[4];
  const double longitude = command.parameters[5];
  if (is_nothing(latitude) && is_nothing(longitude)) return std::nullopt;
  return Place{radians_from_degrees(latitude), radians_from_degrees(longitude)};
}

Altitude altitude_in(const MissionCommand& command) {
  return {Metres{command.parameters[6]}, altitude_frame(command.frame).value_or(AltitudeFrame::msl)};
}

template <class Integer>
std::optional<Integer> integer_in(double parameter) {
  if (!(parameter >= 0 && parameter <= std::numeric_limits<Integer>::max())) return std::nullopt;
  return static_cast<Integer>(parameter);
}

std::optional<Action> speed_in(const MissionCommand& command) {
  const auto kind = integer_in<std::uint8_t>(command.parameters[0]);
  if (!kind || *kind > static_cast<std::uint8_t>(SpeedKind::descent) || !(command.parameters[1] >= 0))
    return std::nullopt;
  SpeedItem item{
      .kind = static_cast<SpeedKind>(*kind), .speed = MetresPerSecond{command.parameters[1]}, .throttle = {}};
  if (command.parameters[2] >= 0) item.throttle = Percent{command.parameters[2]};
  return item;
}

std::optional<Action> jump_in(const MissionCommand& command) {
  const auto target = integer_in<std::uint16_t>(command.parameters[0]);
  if (!target) return std::nullopt;
  return JumpItem{.target = *target, .times = integer_in<std::uint16_t>(command.parameters[1])};
}

std::optional<Action> pictures_in(const MissionCommand& command) {
  const auto count = integer_in<std::uint32_t>(or_zero(command.parameters[2]));
  if (!count) return std::nullopt;
  return TakePicturesItem{.interval = Seconds{or_zero(command.parameters[1])}, .count = *count};
}

std::optional<Action> gimbal_in(const MissionCommand& command) {
  const auto pitch = angle_in(command.parameters[0]);
  const auto roll = angle_in(command.parameters[1]);
  const auto yaw = angle_in(command.parameters[2]);
  if (!pitch || !roll || !yaw) return std::nullopt;
  return GimbalItem{*pitch, *roll, *yaw};
}

/// The item that this command most likely is; parameters that the item has no place for are not looked at.
std::optional<Action> likely_item(const MissionCommand& command) {
  const auto& p = command.parameters;
  const auto place = place_in(command);
  const auto altitude = altitude_in(command);
  switch (command.command) {
    case nav_waypoint:
      if (!place || p[0] < 0) return std::nullopt;
      return WaypointItem{.place = *place,
                          .altitude = altitude,
                          .dwell = Seconds{or_zero(p[0])},
                          .acceptance_radius = Metres{or_zero(p[1])},
                          .pass_radius = Metres{or_zero(p[2])},
                          .yaw = angle_in(p[3])};
    case nav_loiter_unlim: return LoiterItem{place, altitude, Unlimited{}, Metres{or_zero(p[2])}, angle_in(p[3])};
    case nav_loiter_turns: return LoiterItem{place, altitude, Turns{or_zero(p[0])}, Metres{or_zero(p[2])}, {}};
    case nav_loiter_time: return LoiterItem{place, altitude, Seconds{or_zero(p[0])}, Metres{or_zero(p[2])}, {}};
    case nav_return_to_launch: return ReturnItem{};
    case nav_land: return LandItem{place, altitude, Metres{or_zero(p[0])}, angle_in(p[3])};
    case nav_takeoff: return TakeOffItem{place, altitude, radians_from_degrees(or_zero(p[0])), angle_in(p[3])};
    case nav_delay:
      if (!(p[0] >= 0)) return std::nullopt;
      return DelayItem{Seconds{p[0]}};
    case do_jump: return jump_in(command);
    case do_change_speed: return speed_in(command);
    case do_set_roi_location:
      if (!place) return std::nullopt;
      return LookAtItem{LookAtItem::Target{*place, altitude}};
    case do_set_roi_none: return LookAtItem{};
    case do_mount_control: return gimbal_in(command);
    case do_set_cam_trigg_dist: return CameraDistanceItem{Metres{or_zero(p[0])}, p[2] == 1};
    case image_start_capture: return pictures_in(command);
    case image_stop_capture: return StopPicturesItem{};
    default: return std::nullopt;
  }
}

// Writing parameters.

double degrees(const std::optional<Radians>& angle) { return angle ? degrees_from_radians(*angle) : nothing; }

MissionCommand placed(std::uint16_t command, const std::optional<Place>& place, const Altitude& altitude,
                      std::array<double, 4> first = {}) {
  return {command,
          mav_frame(altitude.above),
          {first[0], first[1], first[2], first[3], place ? degrees_from_radians(place->latitude) : nothing,
           place ? degrees_from_radians(place->longitude) : nothing, altitude.height.value}};
}

MissionCommand placeless(std::uint16_t command, std::array<double, 7> parameters = {}) {
  return {command, frame_mission, parameters};
}

MissionCommand expressed(const TakeOffItem& item) {
  return placed(nav_takeoff, item.place, item.altitude,
                {degrees_from_radians(item.minimum_pitch), 0, 0, degrees(item.yaw)});
}
MissionCommand expressed(const WaypointItem& item) {
  return placed(nav_waypoint, item.place, item.altitude,
                {item.dwell.count(), item.acceptance_radius.value, item.pass_radius.value, degrees(item.yaw)});
}
MissionCommand expressed(const LoiterItem& item) {
  const double radius = item.radius.value;
  if (const auto* turns = std::get_if<Turns>(&item.lasts))
    return placed(nav_loiter_turns, item.place, item.altitude, {turns->value, 0, radius, 0});
  if (const auto* time = std::get_if<Seconds>(&item.lasts))
    return placed(nav_loiter_time, item.place, item.altitude, {time->count(), 0, radius, 0});
  return placed(nav_loiter_unlim, item.place, item.altitude, {0, 0, radius, degrees(item.yaw)});
}
MissionCommand expressed(const LandItem& item) {
  return placed(nav_land, item.place, item.altitude, {item.abort_altitude.value, 0, 0, degrees(item.yaw)});
}
MissionCommand expressed(const ReturnItem&) { return placeless(nav_return_to_launch); }
MissionCommand expressed(const SpeedItem& item) {
  const double throttle = item.throttle ? item.throttle->value : unchanged;
  return placeless(do_change_speed, {static_cast<double>(item.kind), item.speed.value, throttle});
}
MissionCommand expressed(const DelayItem& item) {
  constexpr double no_clock_time = -1;
  return placeless(nav_delay, {item.duration.count(), no_clock_time, no_clock_time, no_clock_time});
}
MissionCommand expressed(const JumpItem& item) {
  return placeless(do_jump, {static_cast<double>(item.target), item.times ? *item.times : for_ever});
}
MissionCommand expressed(const CameraDistanceItem& item) {
  return placeless(do_set_cam_trigg_dist, {item.spacing.value, 0, item.first_now ? 1.0 : 0.0});
}
MissionCommand expressed(const TakePicturesItem& item) {
  return placeless(image_start_capture, {0, item.interval.count(), static_cast<double>(item.count)});
}
MissionCommand expressed(const StopPicturesItem&) { return placeless(image_stop_capture); }
MissionCommand expressed(const LookAtItem& item) {
  if (!item.target) return placeless(do_set_roi_none);
  return placed(do_set_roi_location, item.target->place, item.target->altitude);
}
MissionCommand expressed(const GimbalItem& item) {
  return placeless(do_mount_control, {degrees_from_radians(item.pitch), degrees_from_radians(item.roll),
                                      degrees_from_radians(item.yaw), 0, 0, 0, mount_by_angles});
}
MissionCommand expressed(const OtherItem& item) { return item; }

/// True when nothing of `came` is lost in `written`. 0 and NaN both leave a parameter to the vehicle; where they differ
/// in meaning, `likely_item` has told them apart. An altitude is never left to the vehicle.
bool says_all(const MissionCommand& written, const MissionCommand& came) {
  const auto same = [](double a, double b) { return a == b || (is_nothing(a) && is_nothing(b)); };
  if (!std::ranges::equal(written.parameters, came.parameters, same)) return false;
  if (written.frame == frame_mission) return true;
  return altitude_frame(written.frame) == altitude_frame(came.frame) && std::isfinite(came.parameters[6]) &&
         (!place_in(came) || (std::abs(came.parameters[4]) <= 90 && std::abs(came.parameters[5]) <= 180));
}

}  // namespace

Action interpret(const MissionCommand& command) {
  if (std::ranges::any_of(command.parameters, [](double parameter) { return std::isinf(parameter); })) return command;
  const auto item = likely_item(command);
  return item && says_all(express(*item), command) ? *item : command;
}

MissionCommand express(const Action& action) {
  return std::visit([](const auto& item) { return expressed(item); }, action);
}

bool has_place(std::uint16_t command) {
  static constexpr std::array<std::uint16_t, 24> commands{16, 17, 18, 19, 21,  22,  25,  31,  34,  35,  36,   81,
                                                          82, 84, 85, 94, 179, 188, 189, 192, 195, 201, 4501, 5100};
  const auto is_between = [&](std::uint16_t first, std::uint16_t last) { return first <= command && command <= last; };
  constexpr std::uint16_t nav_fence_return_point = 5000;
  constexpr std::uint16_t nav_fence_circle_exclusion = 5004;
  constexpr std::uint16_t waypoint_user_1 = 31000;
  constexpr std::uint16_t spatial_user_5 = 31009;
  return std::ranges::find(commands, command) != commands.end() ||
         is_between(nav_fence_return_point, nav_fence_circle_exclusion) || is_between(waypoint_user_1, spatial_user_5);
}

std::optional<AltitudeFrame> altitude_frame(std::uint8_t mav_frame) {
  switch (mav_frame) {
    case 0:  // MAV_FRAME_GLOBAL
    case 5: return AltitudeFrame::msl;
    case 3:  // MAV_FRAME_GLOBAL_RELATIVE_ALT
    case 6: return AltitudeFrame::home;
    case 10:  // MAV_FRAME_GLOBAL_TERRAIN_ALT
    case 11: return AltitudeFrame::terrain;
    default: return std::nullopt;
  }
}

std::uint8_t mav_frame(AltitudeFrame frame) {
  switch (frame) {
    case AltitudeFrame::msl: return 0;
    case AltitudeFrame::home: return 3;
    case AltitudeFrame::terrain: return 10;
  }
  return 0;
}

}  // namespace ponte::vehicle
