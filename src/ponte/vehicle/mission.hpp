#pragma once

#include "ponte/core/quantity.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// What a mission is, in SI units and in no protocol's numbers. Only `OtherItem`, which Ponte does not interpret, keeps
/// the numbers it came with, so that it leaves unchanged.
namespace ponte::vehicle {

using Seconds = std::chrono::duration<double>;

/// On the WGS-84 ellipsoid.
struct Place {
  Radians latitude{};   ///< north positive, -pi/2 to pi/2
  Radians longitude{};  ///< east positive, -pi to pi
  friend bool operator==(const Place&, const Place&) = default;
};

enum class AltitudeFrame : std::uint8_t {
  msl,      ///< above mean sea level
  home,     ///< above the home position
  terrain,  ///< above the ground below
};

struct Altitude {
  Metres height{};
  AltitudeFrame above{};
  friend bool operator==(const Altitude&, const Altitude&) = default;
};

// What a vehicle is to do. An absent place is where the vehicle then is; an absent yaw is the vehicle's own choice.

struct TakeOffItem {
  std::optional<Place> place{};
  Altitude altitude{};
  Radians minimum_pitch{};  ///< of a fixed wing while it climbs
  std::optional<Radians> yaw{};
  friend bool operator==(const TakeOffItem&, const TakeOffItem&) = default;
};

struct WaypointItem {
  Place place{};
  Altitude altitude{};
  Seconds dwell{};             ///< how long to stay there
  Metres acceptance_radius{};  ///< reached when this near; 0: the vehicle's own
  Metres pass_radius{};        ///< passed at this distance, positive clockwise; 0: flown through
  std::optional<Radians> yaw{};
  friend bool operator==(const WaypointItem&, const WaypointItem&) = default;
};

struct Turns {
  double value{};
  friend bool operator==(const Turns&, const Turns&) = default;
};
struct Unlimited {
  friend bool operator==(const Unlimited&, const Unlimited&) = default;
};

/// Circles, or hovers where the vehicle can.
struct LoiterItem {
  std::optional<Place> place{};
  Altitude altitude{};
  std::variant<Unlimited, Turns, Seconds> lasts{};
  Metres radius{};               ///< positive clockwise; 0: the vehicle's own
  std::optional<Radians> yaw{};  ///< only of an unlimited one
  friend bool operator==(const LoiterItem&, const LoiterItem&) = default;
};

struct LandItem {
  std::optional<Place> place{};
  Altitude altitude{};      ///< of the ground, or of the approach; 0 where it is not known
  Metres abort_altitude{};  ///< to climb to when landing is given up; 0: the vehicle's own
  std::optional<Radians> yaw{};
  friend bool operator==(const LandItem&, const LandItem&) = default;
};

/// Back to home or to a rally point, and land there.
struct ReturnItem {
  friend bool operator==(const ReturnItem&, const ReturnItem&) = default;
};

enum class SpeedKind : std::uint8_t { air, ground, climb, descent };

struct SpeedItem {
  SpeedKind kind{};
  MetresPerSecond speed{};
  std::optional<Percent> throttle{};  ///< absent: unchanged
  friend bool operator==(const SpeedItem&, const SpeedItem&) = default;
};

/// Waits where it is.
struct DelayItem {
  Seconds duration{};
  friend bool operator==(const DelayItem&, const DelayItem&) = default;
};

/// Goes on with another item.
struct JumpItem {
  std::size_t target{};                  ///< index in `Mission::items`, from 0
  std::optional<std::uint16_t> times{};  ///< absent: for ever
  friend bool operator==(const JumpItem&, const JumpItem&) = default;
};

/// Takes a picture each time this distance has been flown.
struct CameraDistanceItem {
  Metres spacing{};  ///< 0: no more pictures
  bool first_now{};  ///< the first one at once
  friend bool operator==(const CameraDistanceItem&, const CameraDistanceItem&) = default;
};

struct TakePicturesItem {
  Seconds interval{};     ///< from one picture to the next
  std::uint32_t count{};  ///< 0: until told to stop
  friend bool operator==(const TakePicturesItem&, const TakePicturesItem&) = default;
};

struct StopPicturesItem {
  friend bool operator==(const StopPicturesItem&, const StopPicturesItem&) = default;
};

/// Nose or camera keep looking at a place; without one they look ahead again.
struct LookAtItem {
  struct Target {
    Place place;
    Altitude altitude;
    friend bool operator==(const Target&, const Target&) = default;
  };
  std::optional<Target> target{};
  friend bool operator==(const LookAtItem&, const LookAtItem&) = default;
};

/// Angles of the camera mount.
struct GimbalItem {
  Radians pitch{};  ///< up positive
  Radians roll{};
  Radians yaw{};  ///< from the nose, clockwise
  friend bool operator==(const GimbalItem&, const GimbalItem&) = default;
};

/// Something else, in the numbers of MAVLink, which mission files share. It is passed on and never looked into.
struct OtherItem {
  std::uint16_t command{};             ///< MAV_CMD
  std::uint8_t frame{};                ///< MAV_FRAME
  std::array<double, 7> parameters{};  ///< places in degrees; NaN: left to the vehicle
  /// NaN equals NaN.
  friend bool operator==(const OtherItem& a, const OtherItem& b);
};

using Action = std::variant<TakeOffItem, WaypointItem, LoiterItem, LandItem, ReturnItem, SpeedItem, DelayItem, JumpItem,
                            CameraDistanceItem, TakePicturesItem, StopPicturesItem, LookAtItem, GimbalItem, OtherItem>;

struct MissionItem {
  Action action{};
  bool waits{};        ///< the vehicle stops after it until it is told to go on
  std::string name{};  ///< for people; empty: none
  friend bool operator==(const MissionItem&, const MissionItem&) = default;
};

struct Home {
  Place place{};
  Metres altitude_msl{};
  friend bool operator==(const Home&, const Home&) = default;
};

struct FencePolygon {
  std::vector<Place> corners{};  ///< at least 3; the last is joined to the first
  bool inclusion{true};          ///< the vehicle stays inside; false: outside
  friend bool operator==(const FencePolygon&, const FencePolygon&) = default;
};

struct FenceCircle {
  Place centre{};
  Metres radius{};
  bool inclusion{true};
  friend bool operator==(const FenceCircle&, const FenceCircle&) = default;
};

/// A place to return to instead of home.
struct RallyPoint {
  Place place{};
  Altitude altitude{};
  friend bool operator==(const RallyPoint&, const RallyPoint&) = default;
};

/// Items that a ground station made from a pattern, e.g. a survey, and the pattern as its file has it.
struct Pattern {
  std::size_t first{};  ///< index of its first item in `Mission::items`
  std::size_t count{};  ///< how many items it made; 0 where its file does not tell
  std::string kind{};   ///< "survey", "CorridorScan", ...
  std::string text{};   ///< in the file's own language
  friend bool operator==(const Pattern&, const Pattern&) = default;
};

struct Mission {
  std::optional<Home> home{};
  std::vector<MissionItem> items{};
  std::vector<Pattern> patterns{};  ///< by their first items, none overlapping
  std::vector<FencePolygon> fence_polygons{};
  std::vector<FenceCircle> fence_circles{};
  std::optional<RallyPoint> fence_return{};  ///< where to go after a breach of the fence
  std::vector<RallyPoint> rally_points{};
  std::optional<MetresPerSecond> cruise_speed{};  ///< of a fixed wing
  std::optional<MetresPerSecond> hover_speed{};   ///< of a copter
  std::uint8_t autopilot{};                       ///< MAV_AUTOPILOT, for a ground station's information; 0: any
  std::uint8_t airframe{};                        ///< MAV_TYPE, likewise
  friend bool operator==(const Mission&, const Mission&) = default;
};

/// Where an item takes the vehicle; nothing for one that does not move it, or that Ponte does not interpret.
[[nodiscard]] std::optional<Place> place_of(const Action& action);

}  // namespace ponte::vehicle
