#include "ponte/planning/flight_mission.hpp"

#include <utility>

namespace ponte::planning {
namespace {

/// Writes down one flight.
class MissionWriter {
 public:
  MissionWriter(const Task& task, const Craft& craft, const Flight& flight, bool takes_pictures)
      : task_{task}, craft_{craft}, flight_{flight}, takes_pictures_{takes_pictures} {}

  vehicle::Mission write() {
    begin();
    for (const auto& leg : flight_.legs) {
      for (const auto& turn : leg.turns) fly_by(turn, leg.altitude);
      if (leg.line)
        follow(leg);
      else if (leg.stop)
        visit(task_.points[*leg.stop], leg);
    }
    land();
    return std::move(mission_);
  }

 private:
  void add(vehicle::Action action, std::string name = {}) {
    mission_.items.push_back({.action = std::move(action), .name = std::move(name)});
  }

  [[nodiscard]] vehicle::Altitude raised(vehicle::Altitude altitude) const {
    altitude.height = altitude.height + flight_.added_altitude;
    return altitude;
  }

  void fly_by(const vehicle::Place& place, const vehicle::Altitude& altitude) {
    add(vehicle::WaypointItem{.place = place, .altitude = raised(altitude)});
  }

  void begin() {
    if (craft_.sets_speed) (craft_.turn_radius.value > 0 ? mission_.cruise_speed : mission_.hover_speed) = craft_.speed;
    if (flight_.wait.count() > 0) add(vehicle::DelayItem{flight_.wait});
    add(vehicle::TakeOffItem{.place = craft_.start, .altitude = raised(flight_.legs.front().altitude)});
    if (craft_.sets_speed)
      add(vehicle::SpeedItem{
          .kind = craft_.turn_radius.value > 0 ? vehicle::SpeedKind::air : vehicle::SpeedKind::ground,
          .speed = craft_.speed});
  }

  void visit(const PointOfInterest& point, const Flight::Leg& leg) {
    // What cannot hover stays by flying circles.
    if (craft_.turn_radius.value > 0 && point.dwell.count() > 0)
      add(vehicle::LoiterItem{.place = leg.target,
                              .altitude = raised(leg.altitude),
                              .lasts = point.dwell,
                              .radius = craft_.turn_radius},
          point.name);
    else
      add(vehicle::WaypointItem{.place = leg.target, .altitude = raised(leg.altitude), .dwell = point.dwell},
          point.name);
    if (takes_pictures_) add(vehicle::TakePicturesItem{.interval = {}, .count = 1});
  }

  void follow(const Flight::Leg& leg) {
    fly_by(leg.line->begin, leg.altitude);
    add(vehicle::CameraDistanceItem{.spacing = leg.line->spacing, .first_now = true});
    fly_by(leg.line->end, leg.altitude);
    add(vehicle::CameraDistanceItem{});
    if (leg.line->run_in.value > 0) fly_by(leg.target, leg.altitude);
  }

  void land() {
    const auto& end = flight_.legs.back();
    const bool comes_home = !end.stop && end.target == craft_.start;
    if (comes_home && flight_.added_altitude == Metres{}) {
      add(vehicle::ReturnItem{});
      return;
    }
    if (comes_home) fly_by(end.target, end.altitude);
    add(vehicle::LandItem{.place = end.target, .altitude = {{}, end.altitude.above}});
  }

  const Task& task_;
  const Craft& craft_;
  const Flight& flight_;
  bool takes_pictures_;
  vehicle::Mission mission_;
};

}  // namespace

vehicle::Mission mission_of(const Task& task, std::size_t craft, const Flight& flight, bool takes_pictures) {
  if (flight.legs.empty()) return {};
  return MissionWriter{task, task.crafts[craft], flight, takes_pictures}.write();
}

}  // namespace ponte::planning
