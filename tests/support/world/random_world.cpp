#include "support/world/random_world.hpp"

#include "support/seed.hpp"
#include "support/world/world.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace ponte::world {

namespace messages = mavlink::autopilots;
using std::chrono::milliseconds;

namespace {

constexpr double metres_per_degree = 111'000;

int world_count(int usual) {
  const char* text = std::getenv("PONTE_WORLDS");
  return text != nullptr ? std::stoi(text) : usual;
}

MissionItem item(std::uint16_t command, double north, double east, float height, const sim::Position& home) {
  const double latitude = degrees_from_radians(home.latitude) + north / metres_per_degree;
  const double shrink = std::cos(home.latitude.value);
  const double longitude = degrees_from_radians(home.longitude) + east / metres_per_degree / shrink;
  return {.target_system = 1,
          .target_component = 1,
          .frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT,
          .command = command,
          .autocontinue = 1,
          .x = static_cast<std::int32_t>(std::llround(latitude * 1e7)),
          .y = static_cast<std::int32_t>(std::llround(longitude * 1e7)),
          .z = height};
}

}  // namespace

double between(Random& random, double least, double most) { return least + (most - least) * random.unit(); }

std::vector<MissionItem> random_mission(Random& random, const sim::VehicleConfig& vehicle) {
  const auto& home = vehicle.start;
  std::vector<MissionItem> items;
  if (vehicle.personality == sim::Personality::ardupilot)
    items.push_back(item(messages::MAV_CMD_NAV_WAYPOINT, 0, 0, 0, home));  // its home
  const auto height = static_cast<float>(between(random, 15, 60));
  items.push_back(item(messages::MAV_CMD_NAV_TAKEOFF, 0, 0, height, home));
  for (auto count = 1 + random.below(8); count > 0; --count) {
    const double north = between(random, -300, 300);
    const double east = between(random, -300, 300);
    items.push_back(item(messages::MAV_CMD_NAV_WAYPOINT, north, east, height, home));
    items.back().param1 = static_cast<float>(random.below(4));
  }
  // A plane that returns goes round until somebody lands it.
  const bool may_return = vehicle.type == sim::AirframeType::copter;
  items.push_back(may_return && random.chance(0.5) ? item(messages::MAV_CMD_NAV_RETURN_TO_LAUNCH, 0, 0, 0, home)
                                                   : item(messages::MAV_CMD_NAV_LAND, 0, 0, 0, home));
  for (std::size_t i = 0; i < items.size(); ++i) items[i].seq = static_cast<std::uint16_t>(i);
  return items;
}

ChannelConfig random_radio(Random& random) {
  ChannelConfig radio{.delay = milliseconds{5 + random.below(200)}};
  radio.jitter = milliseconds{random.below(100)};
  radio.loss = random.chance(0.7) ? between(random, 0, 0.3) : 0;
  radio.burst_begins = random.chance(0.3) ? 0.01 : 0;
  radio.duplication = random.chance(0.3) ? 0.05 : 0;
  radio.reordering = random.chance(0.3) ? 0.05 : 0;
  radio.bit_flips = random.chance(0.3) ? 0.0002 : 0;
  return radio;
}

sim::WindConfig random_wind(Random& random) {
  sim::WindConfig wind{.speed = MetresPerSecond{between(random, 0, 8)}};
  wind.from = radians_from_degrees(between(random, 0, 360));
  wind.gusts = random.chance(0.5) ? 0.2 : 0;
  return wind;
}

sim::VehicleConfig random_vehicle(Random& random) {
  sim::VehicleConfig vehicle{.fly_square = false};
  vehicle.personality = random.chance(0.5) ? sim::Personality::px4 : sim::Personality::ardupilot;
  if (vehicle.personality == sim::Personality::ardupilot && random.chance(0.4)) vehicle.type = sim::AirframeType::plane;
  if (random.chance(0.7)) vehicle.wind = random_wind(random);
  vehicle.seed = random.next();
  return vehicle;
}

void for_each_world(int usual, std::string_view test_program, const std::function<void(std::uint64_t seed)>& live) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + static_cast<std::uint64_t>(world_count(usual)); ++seed) {
    try {
      live(seed);
    } catch (const BrokenProperty& broken) {
      ADD_FAILURE() << "world " << seed << ": " << broken.what() << "\nread it: PONTE_SEED=" << seed
                    << " PONTE_WORLDS=1 PONTE_TIMELINE=1 build/dev/bin/" << test_program;
    }
  }
}

}  // namespace ponte::world
