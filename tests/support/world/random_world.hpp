#pragma once

#include "ponte/core/random.hpp"
#include "ponte/sim/config.hpp"
#include "support/world/channel.hpp"
#include "support/world/pilot.hpp"

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

/// Worlds that are as good or bad as their seed wants them.
namespace ponte::world {

[[nodiscard]] double between(Random& random, double least, double most);

/// One that loses up to 30 %, delays, repeats, reorders and changes bits.
[[nodiscard]] ChannelConfig random_radio(Random& random);
[[nodiscard]] sim::WindConfig random_wind(Random& random);
/// A copter or plane of ArduPilot, or a copter of PX4, that waits for what it is told.
[[nodiscard]] sim::VehicleConfig random_vehicle(Random& random);
/// Take-off, waypoints, and back to the ground.
[[nodiscard]] std::vector<MissionItem> random_mission(Random& random, const sim::VehicleConfig& vehicle);

/// Lets `live` happen for each seed: `usual` of them, or as many as the environment says in PONTE_WORLDS, from
/// PONTE_SEED on. A `BrokenProperty` is a failure of the test, with the line that shows this world alone.
void for_each_world(int usual, std::string_view test_program, const std::function<void(std::uint64_t seed)>& live);

}  // namespace ponte::world
