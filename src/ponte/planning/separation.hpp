#pragma once

#include "ponte/planning/flight_plan.hpp"

/// Keeps the flights of several vehicles apart.
namespace ponte::planning {

/// Two flights are in conflict where they come nearer than `distance` on the map and nearer than `height` in altitude,
/// within `window` seconds, for no flight is quite on time. So long as a vehicle stands on the ground it is in nobody's
/// way.
struct Separation {
  Metres distance{};
  Metres height{};  ///< also between two layers of altitude
  vehicle::Seconds window{};
  vehicle::Seconds wait{};  ///< one take-off is put off by a multiple of it
  int layers_max{};         ///< how many heights may be added
};

struct Conflict {
  std::size_t first{};
  std::size_t second{};     ///< flights
  vehicle::Seconds time{};  ///< when the second is there, about
  vehicle::Place place{};   ///< where it is then
};

/// The conflicts of all pairs of flights as they are, the first one of each pair.
[[nodiscard]] std::vector<Conflict> conflicts(const std::vector<Flight>& flights, const Separation& separation);

/// Gives flights a wait before take-off, and an added altitude, such that no two are in conflict: each in its turn the
/// least wait, and with it the lowest layer, that parts it from those before. A layer that is beyond the endurance of
/// its craft is not taken.
void separate(std::vector<Flight>& flights, const std::vector<Craft>& crafts, const Separation& separation);

/// Flies higher: what it then does, and how long it takes.
[[nodiscard]] Flight raised(const Flight& flight, const Craft& craft, Metres added);

}  // namespace ponte::planning
