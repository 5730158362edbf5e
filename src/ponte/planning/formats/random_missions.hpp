#pragma once

#include "ponte/planning/formats/mission_file.hpp"
#include "ponte/core/random.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

/// Points and missions of every kind, for tests that hold for any.
namespace ponte::planning {

class RandomMissions {
 public:
  explicit RandomMissions(std::uint64_t seed) : random_{seed} {}

  [[nodiscard]] MissionFile points() {
    MissionFile file;
    for (auto count = 1 + random_.below(6); count > 0; --count) file.points.push_back(point());
    while (random_.chance(0.3)) file.mission.fence_polygons.push_back(polygon());
    return file;
  }

  [[nodiscard]] MissionFile mission() {
    MissionFile file;
    auto& mission = file.mission;
    const auto count = 1 + random_.below(8);
    for (std::uint32_t i = 0; i < count; ++i)
      mission.items.push_back({.action = action(count), .waits = random_.chance(0.2), .name = {}});
    if (random_.chance(0.5)) mission.home = vehicle::Home{place(), metres()};
    return file;
  }

  [[nodiscard]] MissionFile mission_with_zones() {
    auto file = mission();
    auto& mission = file.mission;
    while (random_.chance(0.5)) mission.fence_polygons.push_back(polygon());
    while (random_.chance(0.5))
      mission.fence_circles.push_back({place(), Metres{1.0 + random_.below(1000)}, random_.chance(0.5)});
    while (random_.chance(0.5)) mission.rally_points.push_back(rally_point());
    if (random_.chance(0.2)) mission.fence_return = rally_point();
    if (random_.chance(0.5)) mission.cruise_speed = MetresPerSecond{fraction(30)};
    if (random_.chance(0.5)) mission.hover_speed = MetresPerSecond{fraction(30)};
    mission.autopilot = static_cast<std::uint8_t>(random_.below(256));
    mission.airframe = static_cast<std::uint8_t>(random_.below(256));
    return file;
  }

 private:
  /// From 0 to below `end`, with a few decimals.
  double fraction(std::uint32_t end) { return static_cast<double>(random_.below(end * 1000)) / 1000; }
  Metres metres() { return Metres{fraction(2000) - 500}; }
  /// A multiple of 1e-7 degrees, or of 1e-9, which is nearer than any sensor tells.
  double degrees(double half) {
    const double unit = random_.chance(0.5) ? 1e7 : 1e9;
    return static_cast<double>(static_cast<std::int64_t>((random_.unit() * 2 - 1) * half * unit)) / unit;
  }
  vehicle::Place place() {
    const double latitude = degrees(90);
    return {radians_from_degrees(latitude), radians_from_degrees(degrees(180))};
  }
  std::optional<vehicle::Place> place_or_none() { return random_.chance(0.7) ? std::optional{place()} : std::nullopt; }
  vehicle::Altitude altitude() {
    const auto frame = static_cast<vehicle::AltitudeFrame>(random_.below(3));
    return {metres(), frame};
  }
  Radians angle() { return radians_from_degrees(fraction(360) - 180); }
  std::optional<Radians> yaw() { return random_.chance(0.5) ? std::optional{angle()} : std::nullopt; }
  vehicle::Seconds seconds() { return vehicle::Seconds{random_.chance(0.5) ? 0 : fraction(60)}; }

  vehicle::RallyPoint rally_point() {
    const auto where = place();
    return {where, {metres(), vehicle::AltitudeFrame::home}};
  }

  vehicle::FencePolygon polygon() {
    vehicle::FencePolygon fence;
    for (auto count = 3 + random_.below(4); count > 0; --count) fence.corners.push_back(place());
    fence.inclusion = random_.chance(0.5);
    return fence;
  }

  PointOfInterest point() {
    constexpr std::array names{"mast",       "a & b <c>", "\"quoted\", and; more", "Z\u00fcrich \u2708 \U0001F681",
                               "two\nlines", "]]> &amp;", "back\\slash {0}",       "\ttab"};
    PointOfInterest result{.place = place()};
    if (random_.chance(0.7)) result.altitude = altitude();
    result.dwell = seconds();
    if (random_.chance(0.5)) result.priority = fraction(10);
    if (random_.chance(0.5)) result.sensor_quality = fraction(1);
    if (random_.chance(0.5)) result.name = names[random_.below(names.size())];
    return result;
  }

  vehicle::LoiterItem loiter() {
    vehicle::LoiterItem item{.place = place_or_none(), .altitude = altitude(), .radius = metres()};
    switch (random_.below(3)) {
      case 0: item.lasts = vehicle::Turns{fraction(9)}; break;
      case 1: item.lasts = seconds(); break;
      default: item.yaw = yaw();
    }
    return item;
  }

  vehicle::OtherItem other() {
    vehicle::OtherItem item{.command = 42'000, .frame = static_cast<std::uint8_t>(random_.below(22)), .parameters = {}};
    for (auto& parameter : item.parameters) parameter = random_.chance(0.2) ? std::nan("") : fraction(1000) - 500;
    return item;
  }

  vehicle::Action action(std::uint32_t item_count) {
    switch (random_.below(14)) {
      case 0: {
        vehicle::TakeOffItem item{.place = place_or_none(), .altitude = altitude(), .minimum_pitch = angle()};
        item.yaw = yaw();
        return item;
      }
      case 1: {
        vehicle::WaypointItem item{.place = place(), .altitude = altitude(), .dwell = seconds()};
        item.acceptance_radius = Metres{fraction(9)};
        item.pass_radius = metres();
        item.yaw = yaw();
        return item;
      }
      case 2: return loiter();
      case 3: {
        vehicle::LandItem item{
            .place = place_or_none(), .altitude = altitude(), .abort_altitude = Metres{fraction(50)}};
        item.yaw = yaw();
        return item;
      }
      case 4: return vehicle::ReturnItem{};
      case 5: {
        vehicle::SpeedItem item{.kind = static_cast<vehicle::SpeedKind>(random_.below(4))};
        item.speed = MetresPerSecond{fraction(30)};
        if (random_.chance(0.5)) item.throttle = Percent{fraction(100)};
        return item;
      }
      case 6: return vehicle::DelayItem{vehicle::Seconds{fraction(60)}};
      case 7: {
        vehicle::JumpItem item{.target = random_.below(item_count)};
        if (random_.chance(0.5)) item.times = static_cast<std::uint16_t>(random_.below(65536));
        return item;
      }
      case 8: return vehicle::CameraDistanceItem{.spacing = Metres{fraction(100)}, .first_now = random_.chance(0.5)};
      case 9: return vehicle::TakePicturesItem{.interval = seconds(), .count = random_.below(1000)};
      case 10: return vehicle::StopPicturesItem{};
      case 11: {
        if (random_.chance(0.2)) return vehicle::LookAtItem{};
        const auto target = place();
        return vehicle::LookAtItem{vehicle::LookAtItem::Target{target, altitude()}};
      }
      case 12: {
        vehicle::GimbalItem item{.pitch = angle()};
        item.roll = angle();
        item.yaw = angle();
        return item;
      }
      default: return other();
    }
  }

  Random random_;
};

}  // namespace ponte::planning
