// upload_mission PORT COUNT: uploads a take-off and so many waypoints in a row, and reads them back.
#include "udp_station.hpp"

#include "ponte/autopilot/wire_mission.hpp"
#include "ponte/core/degrees.hpp"

int main(int argc, char** argv) {
  using namespace example;
  namespace vehicle = ponte::vehicle;
  if (argc != 3) return 2;
  UdpStation station{static_cast<std::uint16_t>(std::atoi(argv[1]))};
  const vehicle::Altitude height{ponte::Metres{30}, vehicle::AltitudeFrame::home};
  vehicle::Mission mission;
  mission.items.push_back({vehicle::TakeOffItem{.altitude = height}});
  for (int i = 0; i < std::atoi(argv[2]); ++i) {
    const vehicle::Place place{ponte::radians_from_degrees(-30.069 + 0.001 * i), ponte::radians_from_degrees(-51.1218)};
    mission.items.push_back({vehicle::WaypointItem{.place = place, .altitude = height}});
  }

  auto& client = station.vehicle();
  const auto items = autopilot::to_wire(client.peer().stack, autopilot::PlanType::mission, mission);
  if (!items) give_up(items.error().what);
  const auto fact = station.carry_out<autopilot::MissionFact>([&](Timestamp now, autopilot::Voice& voice) {
    return client.missions().upload(now, autopilot::PlanType::mission, *items, voice);
  });
  if (fact.kind != autopilot::MissionFact::Kind::uploaded) give_up("it is not on board");
  std::printf("%zu items on board\n", items->size());
}
