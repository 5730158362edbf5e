#include "support/seed.hpp"
#include "support/world/pilot.hpp"
#include "support/world/vehicle_node.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

// Whole flights: a pilot, a radio and a vehicle, each of them as good or bad as the seed wants it.
namespace ponte::world {
namespace {

namespace messages = mavlink::autopilots;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

constexpr double metres_per_degree = 111'000;

/// How many worlds: as many as the environment says in PONTE_WORLDS.
int world_count() {
  const char* text = std::getenv("PONTE_WORLDS");
  return text != nullptr ? std::stoi(text) : 300;
}

double between(Random& random, double least, double most) { return least + (most - least) * random.unit(); }

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

/// Take-off, waypoints, and back to the ground.
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

struct Totals {
  int worlds{};
  double hours{};
  int faults{};
};

/// One flight from the first HEARTBEAT to the ground.
class FlightWorld {
 public:
  explicit FlightWorld(std::uint64_t seed) : world_{seed}, random_{seed}, config_{random_vehicle(random_)} {
    vehicle_ = &world_.add<VehicleNode>("vehicle", config_);
    mission_ = random_mission(random_, config_);
    pilot_ = &world_.add<Pilot>(
        "pilot",
        PilotConfig{.vehicle = config_.system, .kind = {config_.personality, config_.type}, .mission = mission_});
    link_ = world_.connect(*vehicle_, *pilot_, random_radio(random_));
    plan_faults();
    world_.require("nothing flies below the ground", [this]() -> std::optional<std::string> {
      const auto height = truth().position.altitude_msl.value - config_.start.altitude_msl.value;
      if (height >= -0.5) return {};
      return fmt::format("{:.1f} m", height);
    });
    world_.require("only what is armed flies by its motors", [this]() -> std::optional<std::string> {
      if (!truth().airborne || truth().armed || truth().crashed || truth().throttle <= 0) return {};
      return "it is airborne, disarmed and its motors turn";
    });
    world_.require("nobody is carried off", [this]() -> std::optional<std::string> {
      const auto& v = truth().velocity;
      const double speed = std::hypot(v.north, v.east, v.down);
      if (speed < 60) return {};
      return fmt::format("{:.1f} m/s", speed);
    });
    world_.require("what was accepted is what is on board", [this]() -> std::optional<std::string> {
      if (pilot_->difference().empty()) return {};
      return pilot_->difference();
    });
  }

  void fly(Totals& totals) {
    const bool is_done = world_.run_until([this] { return pilot_->is_over(); }, minutes{40});
    ++totals.worlds;
    totals.faults += faults_;
    if (pilot_->started())
      totals.hours += std::chrono::duration<double, std::ratio<3600>>{world_.now() - *pilot_->started()}.count();
    // A plane whose failsafe sends it home goes round there.
    const bool may_stay = config_.type == sim::AirframeType::plane && faults_ > 0;
    if (!is_done && !may_stay)
      throw BrokenProperty{fmt::format("after {:.0f} s the pilot is still at: {}",
                                       std::chrono::duration<double>{world_.now().time_since_epoch()}.count(),
                                       name_of(pilot_->phase()))};
    if (is_done && truth().airborne) throw BrokenProperty{"the pilot is done, but the vehicle is in the air"};
  }

 private:
  [[nodiscard]] const sim::AirframeState& truth() const { return vehicle_->vehicle().truth(); }

  void plan_faults() {
    using enum sim::FaultKind;
    constexpr std::array kinds{battery_low, battery_critical, gps_loss, motor};
    for (auto count = random_.below(3); count > 0; --count) {
      ++faults_;
      const auto at = seconds{15 + random_.below(240)};
      const auto lasts = seconds{1 + random_.below(40)};
      if (random_.chance(0.5)) {
        world_.at(Timestamp{at}, [this, end = Timestamp{at + lasts}] { world_.cut(link_, end); });
        continue;
      }
      const auto kind = kinds[random_.below(kinds.size())];
      vehicle_->vehicle().inject({kind, at, kind == gps_loss ? std::optional<Duration>{lasts} : std::nullopt});
    }
  }

  World world_;
  Random random_;
  sim::VehicleConfig config_;
  std::vector<MissionItem> mission_;
  VehicleNode* vehicle_{};
  Pilot* pilot_{};
  std::size_t link_{};
  int faults_{};
};

TEST(FlightsSeeded, EndOnTheGroundWhateverHappens) {
  Totals totals;
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + static_cast<std::uint64_t>(world_count()); ++seed) {
    try {
      FlightWorld{seed}.fly(totals);
    } catch (const BrokenProperty& broken) {
      ADD_FAILURE() << "world " << seed << ": " << broken.what() << "\nread it: PONTE_SEED=" << seed
                    << " PONTE_WORLDS=1 PONTE_TIMELINE=1 build/dev/bin/flights_test";
    }
  }
  fmt::print("{} worlds, {:.1f} hours flown, {} faults\n", totals.worlds, totals.hours, totals.faults);
}

}  // namespace
}  // namespace ponte::world
