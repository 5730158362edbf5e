#include "support/world/random_world.hpp"
#include "support/world/station_node.hpp"
#include "support/world/vehicle_node.hpp"
#include "support/world/witness.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

// The services of a station against the simulated vehicles.
namespace ponte::world {
namespace {

namespace messages = mavlink::autopilots;
using autopilot::Command;
using autopilot::CommandFact;
using autopilot::CommandId;
using autopilot::ModeFact;
using autopilot::ModeRequestId;
using autopilot::ModeWish;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;
using vehicle::ModeKind;

/// A vehicle, a station, the radio between them, and a witness who hears the vehicle without fail.
class Field {
 public:
  Field(std::uint64_t seed, const sim::VehicleConfig& config, const ChannelConfig& radio)
      : world{seed},
        vehicle{world.add<VehicleNode>("vehicle", config)},
        station{world.add<StationNode>("station")},
        witness{world.add<Witness>("witness", vehicle)},
        link{world.connect(vehicle, station, radio)} {
    world.connect(vehicle, witness, {});
  }

  [[nodiscard]] const sim::AirframeState& truth() const { return vehicle.vehicle().truth(); }
  autopilot::VehicleClient& client() { return *station.client(); }
  /// What became of a wish; a broken property if nothing does.
  ModeFact outcome(ModeRequestId request) {
    std::optional<ModeFact> found;
    const auto is_told = [&] {
      for (const auto& fact : station.facts_of<ModeFact>())
        if (fact.request == request) found = fact;
      return found.has_value();
    };
    if (!world.run_until(is_told, minutes{3})) throw BrokenProperty{"nothing is told of a wish"};
    return *found;
  }

  World world;
  VehicleNode& vehicle;
  StationNode& station;
  Witness& witness;
  std::size_t link;
};

sim::VehicleConfig quiet(sim::Personality personality, sim::AirframeType type = sim::AirframeType::copter) {
  return {.personality = personality, .type = type, .fly_square = false};
}

/// A vehicle of each kind, ready to be armed, on a good cable.
class EachVehicle : public testing::TestWithParam<sim::VehicleConfig> {
 protected:
  EachVehicle() {
    Random random{1};
    load_mission(field.vehicle.vehicle(), field.world.now(), random_mission(random, GetParam()));
    field.world.run_for(seconds{12});
  }
  [[nodiscard]] bool is_plane() const { return GetParam().type == sim::AirframeType::plane; }

  Field field{1, GetParam(), {.delay = milliseconds{20}}};
};

TEST_P(EachVehicle, TakesOffAndReturns) {
  auto voice = field.station.voice();
  const auto height = is_plane() ? std::nullopt : std::optional{Metres{20}};
  const auto up = field.client().modes().take_off(field.world.now(), height, voice);
  ASSERT_TRUE(up) << int(up.error());
  EXPECT_EQ(field.outcome(*up).kind, ModeFact::Kind::done);
  EXPECT_TRUE(field.truth().airborne);
  field.world.run_for(seconds{30});
  const auto above = field.truth().position.altitude_msl - GetParam().start.altitude_msl;
  EXPECT_NEAR(above.value, height.value_or(above).value, 1);

  const auto home = field.client().modes().change_mode(field.world.now(), ModeKind::return_home, voice);
  EXPECT_EQ(field.outcome(*home).kind, ModeFact::Kind::done);
}

TEST_P(EachVehicle, BeginsItsMissionFromTheGroundAndInTheAir) {
  auto voice = field.station.voice();
  const auto begun = field.client().modes().start_mission(field.world.now(), voice);
  ASSERT_TRUE(begun);
  EXPECT_EQ(field.outcome(*begun).kind, ModeFact::Kind::done);
  EXPECT_TRUE(field.truth().airborne);
  const auto held = field.client().modes().change_mode(field.world.now(), ModeKind::hold, voice);
  EXPECT_EQ(field.outcome(*held).kind, ModeFact::Kind::done);
  const auto again = field.client().modes().start_mission(field.world.now(), voice);
  EXPECT_EQ(field.outcome(*again).kind, ModeFact::Kind::done);
}

TEST_P(EachVehicle, ArmsAndDisarmsAndSaysWhyItDoesNot) {
  auto voice = field.station.voice();
  auto& modes = field.client().modes();
  ASSERT_EQ(field.outcome(*modes.change_mode(field.world.now(), ModeKind::manual, voice)).kind, ModeFact::Kind::done);
  EXPECT_EQ(field.outcome(*modes.arm(field.world.now(), voice)).kind, ModeFact::Kind::done);
  EXPECT_TRUE(field.truth().armed);
  EXPECT_EQ(field.outcome(*modes.disarm(field.world.now(), voice)).kind, ModeFact::Kind::done);
  EXPECT_FALSE(field.truth().armed);

  field.vehicle.vehicle().inject({sim::FaultKind::battery_critical, field.world.now() - Timestamp{} + seconds{1}, {}});
  field.world.run_for(seconds{30});
  const auto refused = field.outcome(*modes.arm(field.world.now(), voice));
  EXPECT_EQ(refused.kind, ModeFact::Kind::refused);
  EXPECT_FALSE(refused.reason.empty());
}

INSTANTIATE_TEST_SUITE_P(Services, EachVehicle,
                         testing::Values(quiet(sim::Personality::ardupilot),
                                         quiet(sim::Personality::ardupilot, sim::AirframeType::plane),
                                         quiet(sim::Personality::px4)),
                         [](const auto& vehicle) {
                           if (vehicle.param.personality == sim::Personality::px4) return "Px4";
                           return vehicle.param.type == sim::AirframeType::plane ? "Plane" : "Copter";
                         });

constexpr float no_such_item = 999;

struct Totals {
  int worlds{};
  int requests{};
  int done{};  ///< accepted, or seen to be done
};

/// A station that asks for this and that over a bad radio, while the vehicle may start anew.
class CommandWorld {
 public:
  explicit CommandWorld(std::uint64_t seed)
      : random_{seed}, config_{random_vehicle(random_)}, field_{seed, config_, random_radio(random_)} {
    load_mission(field_.vehicle.vehicle(), field_.world.now(), random_mission(random_, config_));
    plan_faults();
  }

  void live(Totals& totals) {
    if (!field_.world.run_until([this] { return field_.station.client() != nullptr; }, minutes{1}))
      throw BrokenProperty{"the station never hears the vehicle"};
    for (auto left = 6 + random_.below(10); left > 0; --left) {
      field_.world.run_for(milliseconds{100 + random_.below(6000)});
      ask();
    }
    const auto all_answered = [this] { return answers() >= requests(); };
    if (!field_.world.run_until(all_answered, minutes{4})) throw BrokenProperty{"something is never answered"};
    field_.world.run_for(seconds{30});
    judge(totals);
  }

 private:
  void plan_faults() {
    for (auto count = random_.below(3); count > 0; --count) {
      const auto at = seconds{5 + random_.below(60)};
      if (random_.chance(0.3)) {
        field_.vehicle.vehicle().inject({sim::FaultKind::reboot, at, std::nullopt});
        continue;
      }
      const auto lasts = seconds{1 + random_.below(20)};
      field_.world.at(Timestamp{at}, [this, end = Timestamp{at + lasts}] { field_.world.cut(field_.link, end); });
    }
  }

  void ask() {
    auto voice = field_.station.voice();
    const auto now = field_.world.now();
    auto& modes = field_.client().modes();
    const auto mode_for = [&](ModeKind kind) {
      return autopilot::custom_mode_for(field_.client().peer().stack, kind).value_or(0);
    };
    const auto keep = [&](const auto& request, bool arms, ModeKind kind = ModeKind::mission) {
      if (request) wishes_.push_back({*request, now, arms, mode_for(kind)});
    };
    constexpr std::array kinds{ModeKind::manual,      ModeKind::mission, ModeKind::hold,
                               ModeKind::return_home, ModeKind::guided,  ModeKind::land};
    const auto height = config_.type == sim::AirframeType::plane ? std::nullopt : std::optional{Metres{15}};
    switch (random_.below(8)) {
      case 0: return keep(modes.arm(now, voice), true);
      case 1: return keep(modes.disarm(now, voice), false);
      case 2: return keep(modes.take_off(now, height, voice), true);
      case 3: return keep(modes.start_mission(now, voice), true);
      case 4: {
        const auto kind = kinds[random_.below(kinds.size())];
        return keep(modes.change_mode(now, kind, voice), false, kind);
      }
      default: break;
    }
    constexpr std::array commands{
        Command{.number = messages::MAV_CMD_PREFLIGHT_CALIBRATION, .param1 = 1},
        Command{.number = messages::MAV_CMD_DO_CHANGE_SPEED, .param1 = 1, .param2 = 7, .param3 = -1},
        Command{.number = messages::MAV_CMD_DO_SET_HOME, .param1 = 1},
        Command{.number = messages::MAV_CMD_RUN_PREARM_CHECKS},
        Command{.number = 42424},
        Command{.number = messages::MAV_CMD_DO_SET_MISSION_CURRENT, .param1 = 1},
        Command{.number = messages::MAV_CMD_DO_SET_MISSION_CURRENT, .param1 = no_such_item},
        Command{.number = messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, .param1 = 1},
        Command{.number = messages::MAV_CMD_DO_REPOSITION,
                .x = -30.069,
                .y = -51.122,
                .z = 30,
                .frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT},
    };
    const auto& command = commands[random_.below(commands.size())];
    const auto request = field_.client().commands().request(now, command, voice);
    if (!request) return;
    commands_.push_back({*request, command});
    if (random_.chance(0.2)) field_.client().commands().cancel(now, *request, voice);
  }

  [[nodiscard]] std::size_t requests() const { return wishes_.size() + commands_.size(); }
  [[nodiscard]] std::size_t answers() const {
    std::size_t count = 0;
    for (const auto& each : field_.station.facts()) {
      const auto* command = std::get_if<CommandFact>(&each.fact);
      if (command == nullptr || command->is_final()) ++count;
    }
    return count;
  }

  void judge(Totals& totals) {
    if (answers() != requests()) throw BrokenProperty{fmt::format("{} requests and {} answers", requests(), answers())};
    for (const auto& each : commands_) judge(each);
    for (const auto& each : wishes_) judge(each);
    const auto may_arm = static_cast<int>(std::ranges::count(wishes_, true, &Wish::arms));
    if (field_.witness.times_armed() > may_arm)
      throw BrokenProperty{fmt::format("armed {} times for {} wishes", field_.witness.times_armed(), may_arm)};
    ++totals.worlds;
    totals.requests += static_cast<int>(requests());
    for (const auto& fact : field_.station.facts_of<ModeFact>())
      totals.done += fact.kind == ModeFact::Kind::done ? 1 : 0;
    for (const auto& fact : field_.station.facts_of<CommandFact>())
      totals.done += fact.kind == CommandFact::Kind::accepted ? 1 : 0;
  }

  struct Asked {
    CommandId id;
    Command command;
  };
  void judge(const Asked& asked) {
    int finals = 0;
    for (const auto& fact : field_.station.facts_of<CommandFact>()) {
      if (fact.request != asked.id || !fact.is_final()) continue;
      ++finals;
      const bool must_be_denied = asked.command.param1 == no_such_item;
      if (asked.command.number == messages::MAV_CMD_DO_SET_MISSION_CURRENT && fact.result != 0 && !must_be_denied)
        throw BrokenProperty{fmt::format("request {} got the answer to another", asked.id.value)};
      if (fact.kind == CommandFact::Kind::accepted && must_be_denied)
        throw BrokenProperty{fmt::format("request {} got the answer to another", asked.id.value)};
      if (fact.attempts > 1 && !autopilot::may_be_repeated(asked.command, field_.client().peer().stack))
        throw BrokenProperty{fmt::format("command {} was sent {} times", asked.command.number, fact.attempts)};
    }
    if (finals != 1) throw BrokenProperty{fmt::format("{} answers to command {}", finals, asked.command.number)};
  }

  struct Wish {
    ModeRequestId id;
    Timestamp when{};
    bool arms{};
    std::uint32_t mode{};  // if it is one, or that of the mission
  };
  void judge(const Wish& wish) {
    int finals = 0;
    for (const auto& each : field_.station.facts()) {
      const auto* fact = std::get_if<ModeFact>(&each.fact);
      if (fact == nullptr || fact->request != wish.id) continue;
      ++finals;
      if (fact->kind == ModeFact::Kind::done && !came_true(fact->wish, wish, each.time))
        throw BrokenProperty{fmt::format("wish {} is called done, and was not", wish.id.value)};
    }
    if (finals != 1) throw BrokenProperty{fmt::format("{} outcomes of wish {}", finals, wish.id.value)};
  }

  [[nodiscard]] bool came_true(ModeWish kind, const Wish& wish, Timestamp told) const {
    const auto& witness = field_.witness;
    switch (kind) {
      case ModeWish::arm: return witness.was_armed(true, wish.when, told);
      case ModeWish::disarm: return witness.was_armed(false, wish.when, told);
      case ModeWish::take_off: return witness.was_airborne(wish.when, told);
      case ModeWish::start_mission:
        return witness.was_airborne(wish.when, told) && witness.was_in_mode(wish.mode, wish.when, told);
      case ModeWish::change_mode: return witness.was_in_mode(wish.mode, wish.when, told);
    }
    return false;
  }

  Random random_;
  sim::VehicleConfig config_;
  Field field_;
  std::vector<Asked> commands_;
  std::vector<Wish> wishes_;
};

TEST(ServicesSeeded, AnswerEveryCommandOnceAndTruly) {
  Totals totals;
  for_each_world(300, "services_test", [&](std::uint64_t seed) { CommandWorld{seed}.live(totals); });
  fmt::print("{} worlds, {} requests, {} of them done\n", totals.worlds, totals.requests, totals.done);
}

}  // namespace
}  // namespace ponte::world
