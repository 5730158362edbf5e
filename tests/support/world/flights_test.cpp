#include "support/world/pilot.hpp"
#include "support/world/random_world.hpp"
#include "support/world/vehicle_node.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

// Whole flights: a pilot, a radio and a vehicle, each of them as good or bad as the seed wants it.
namespace ponte::world {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;

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

  [[nodiscard]] std::uint64_t digest() const { return world_.digest(); }

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

/// Ten times, and with every compiler that the tests are built with.
TEST(Flights, AreTheSameBytesForTheSameSeed) {
  constexpr std::array<std::uint64_t, 3> digests{0x107597BCDD00C7EA, 0x314ABCCC58F405B4, 0x9168DC876C0855B5};
  for (std::size_t i = 0; i < digests.size(); ++i)
    for (int times = 0; times < 10; ++times) {
      FlightWorld world{i + 1};
      Totals totals;
      world.fly(totals);
      ASSERT_EQ(world.digest(), digests[i]) << "seed " << i + 1;
    }
}

TEST(FlightsSeeded, EndOnTheGroundWhateverHappens) {
  Totals totals;
  for_each_world(300, "flights_test", [&](std::uint64_t seed) { FlightWorld{seed}.fly(totals); });
  fmt::print("{} worlds, {:.1f} hours flown, {} faults\n", totals.worlds, totals.hours, totals.faults);
}

}  // namespace
}  // namespace ponte::world
