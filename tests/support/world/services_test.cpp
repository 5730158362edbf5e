#include "support/world/random_world.hpp"
#include "support/world/station_node.hpp"
#include "support/world/vehicle_node.hpp"
#include "support/world/witness.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/gimbal_device_attitude_status.hpp"

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
using autopilot::GimbalFact;
using autopilot::GimbalRequestId;
using autopilot::GuidedFact;
using autopilot::GuidedRequestId;
using autopilot::ModeFact;
using autopilot::ModeRequestId;
using autopilot::ModeWish;
using autopilot::Motion;
using autopilot::StreamFact;
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
  ModeFact outcome(ModeRequestId request) { return outcome_of<ModeFact>(request); }
  GimbalFact outcome(GimbalRequestId request) { return outcome_of<GimbalFact>(request); }
  GuidedFact outcome(GuidedRequestId request) { return outcome_of<GuidedFact>(request); }
  template <class Fact>
  Fact outcome_of(auto request) {
    std::optional<Fact> found;
    const auto is_told = [&] {
      for (const auto& fact : station.facts_of<Fact>())
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

sim::ParameterSetting with_gimbal(sim::Personality personality) {
  if (personality == sim::Personality::px4) return {"MNT_MODE_IN", 4};
  return {"MNT1_TYPE", 1};
}

sim::VehicleConfig quiet(sim::Personality personality, sim::AirframeType type = sim::AirframeType::copter) {
  sim::VehicleConfig config{.personality = personality, .type = type, .fly_square = false};
  config.parameters = {with_gimbal(personality)};
  config.radio = true;
  return config;
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
  void take_off() {
    auto voice = field.station.voice();
    const auto height = is_plane() ? std::nullopt : std::optional{Metres{20}};
    const auto up = field.client().modes().take_off(field.world.now(), height, voice);
    ASSERT_TRUE(up);
    ASSERT_EQ(field.outcome(*up).kind, ModeFact::Kind::done);
    field.world.run_for(seconds{30});
  }
  /// From where it was switched on.
  [[nodiscard]] sim::NorthEastDown place() const { return offset_between(GetParam().start, field.truth().position); }

  Field field{1, GetParam(), {.delay = milliseconds{20}}};
};

TEST_P(EachVehicle, TakesOffAndReturns) {
  take_off();
  EXPECT_TRUE(field.truth().airborne);
  if (!is_plane()) {
    EXPECT_NEAR(place().down, -20, 1);
  }
  auto voice = field.station.voice();
  const auto home = field.client().modes().change_mode(field.world.now(), ModeKind::return_home, voice);
  EXPECT_EQ(field.outcome(*home).kind, ModeFact::Kind::done);
}

TEST_P(EachVehicle, GoesWhereItIsGuidedTo) {
  take_off();
  auto voice = field.station.voice();
  auto& guided = field.client().guided();
  const auto target = displaced(GetParam().start, {200, 100, 0});
  const auto there = guided.go_to(field.world.now(), {target.latitude, target.longitude, {Metres{60}}}, {}, voice);
  ASSERT_TRUE(there);
  EXPECT_EQ(field.outcome(*there).kind, GuidedFact::Kind::done);
  field.world.run_for(seconds{90});
  const double radius = is_plane() ? 150 : 2;
  EXPECT_NEAR(place().north, 200, radius);
  EXPECT_NEAR(place().east, 100, radius);
  EXPECT_NEAR(place().down, -60, 3);

  const auto higher = guided.change_altitude(field.world.now(), {Metres{80}}, voice);
  ASSERT_TRUE(higher);
  EXPECT_EQ(field.outcome(*higher).kind, GuidedFact::Kind::done);
  field.world.run_for(seconds{40});
  EXPECT_NEAR(place().down, -80, 3);
  EXPECT_NEAR(place().north, 200, radius);

  const auto faster = guided.change_speed(field.world.now(), MetresPerSecond{is_plane() ? 25.0 : 12.0}, voice);
  ASSERT_TRUE(faster);
  EXPECT_EQ(field.outcome(*faster).kind, GuidedFact::Kind::done);
}

TEST_P(EachVehicle, IsSteeredAndStopsWhenNobodySteers) {
  take_off();
  auto voice = field.station.voice();
  auto& stream = field.client().stream();
  const Motion northward{.north = MetresPerSecond{4}};
  if (is_plane()) {
    EXPECT_FALSE(stream.steer(field.world.now(), northward, voice));
    return;
  }
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(stream.steer(field.world.now(), northward, voice));
    field.world.run_for(milliseconds{500});
  }
  EXPECT_NEAR(field.truth().velocity.north, 4, 0.5);
  EXPECT_GT(place().north, 50);
  field.world.run_for(seconds{10});
  EXPECT_NEAR(field.truth().velocity.north, 0, 0.2);
  const auto told = field.station.facts_of<StreamFact>();
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].kind, StreamFact::Kind::steers);
  EXPECT_EQ(told[1].kind, StreamFact::Kind::held);
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

TEST_P(EachVehicle, PointsItsGimbalForWhoeverIsInControl) {
  auto voice = field.station.voice();
  auto& gimbal = field.client().gimbal();
  const auto now = [this] { return field.world.now(); };
  EXPECT_EQ(field.outcome(*gimbal.find_manager(now(), voice)).kind, GimbalFact::Kind::done);
  const autopilot::Pointing pointing{radians_from_degrees(-40), radians_from_degrees(70), autopilot::YawFrame::nose};
  EXPECT_FALSE(gimbal.point(now(), pointing, voice)) << "nobody is in control yet";
  EXPECT_EQ(field.outcome(*gimbal.take_control(now(), voice)).kind, GimbalFact::Kind::done);
  EXPECT_EQ(field.outcome(*gimbal.point(now(), pointing, voice)).kind, GimbalFact::Kind::done);
  static_cast<void>(field.client().commands().request(
      now(),
      {.number = messages::MAV_CMD_SET_MESSAGE_INTERVAL,
       .param1 = static_cast<float>(messages::GimbalDeviceAttitudeStatus::info.id.value),
       .param2 = 200'000},
      voice));
  field.world.run_for(seconds{5});
  ASSERT_TRUE(gimbal.attitude());
  EXPECT_NEAR(gimbal.attitude()->pitch.value, pointing.pitch->value, 0.02);
  EXPECT_NEAR(gimbal.attitude()->yaw.value, pointing.yaw->value, 0.02);
  EXPECT_EQ(field.outcome(*gimbal.release_control(now(), voice)).kind, GimbalFact::Kind::done);
  EXPECT_FALSE(gimbal.point(now(), pointing, voice));
}

TEST_P(EachVehicle, KnowsHowWellItIs) {
  const auto now = field.world.now();
  const auto& health = field.client().health();
  ASSERT_TRUE(health.estimator(now) && health.satellites(now) && health.battery(now) && health.sensors(now));
  EXPECT_TRUE(health.estimator(now)->attitude && health.estimator(now)->position);
  EXPECT_LT(health.estimator(now)->worst_ratio, 1);
  EXPECT_GE(health.satellites(now)->fix_type, 3);
  EXPECT_GT(health.battery(now)->remaining.value_or(Percent{}).value, 90);
  field.vehicle.vehicle().inject({sim::FaultKind::gps_loss, now - Timestamp{} + seconds{1}, {}});
  field.world.run_for(seconds{30});
  EXPECT_LT(health.satellites(field.world.now())->fix_type, 3);
  field.world.cut(field.link, field.world.now() + seconds{30});
  field.world.run_for(seconds{20});
  EXPECT_FALSE(health.battery(field.world.now())) << "nothing has come for too long";
}

TEST_P(EachVehicle, KnowsItsClockAndHowGoodTheLinkIs) {
  const auto& client = field.client();
  field.world.run_for(seconds{20});
  const auto reading = client.time_sync().best();
  ASSERT_TRUE(reading);
  EXPECT_GE(reading->round_trip, milliseconds{40});
  EXPECT_LE(reading->round_trip, milliseconds{60});
  EXPECT_LE(std::chrono::abs(reading->offset), reading->round_trip / 2) << "it was switched on when this began";
  EXPECT_EQ(client.link_quality().loss(field.world.now()), Percent{0});
  EXPECT_TRUE(client.link_quality().radio(field.world.now()));
}

INSTANTIATE_TEST_SUITE_P(Services, EachVehicle,
                         testing::Values(quiet(sim::Personality::ardupilot),
                                         quiet(sim::Personality::ardupilot, sim::AirframeType::plane),
                                         quiet(sim::Personality::px4)),
                         [](const auto& vehicle) {
                           if (vehicle.param.personality == sim::Personality::px4) return "Px4";
                           return vehicle.param.type == sim::AirframeType::plane ? "Plane" : "Copter";
                         });

constexpr float no_such_number = 60'999;  // of a mission item, or of a message

struct Totals {
  int worlds{};
  int requests{};
  int done{};  ///< accepted, or seen to be done
};

/// A station that asks for this and that over a bad radio, while the vehicle may start anew.
class CommandWorld {
 public:
  explicit CommandWorld(std::uint64_t seed)
      : random_{seed},
        config_{fitted_out(random_vehicle(random_), random_)},
        field_{seed, config_, random_radio(random_)} {
    load_mission(field_.vehicle.vehicle(), field_.world.now(), random_mission(random_, config_));
    plan_faults();
    // In MAVLink 1 nobody could tell whose answer is whose.
    if (config_.version == mavlink::Version::v2 && random_.chance(0.5)) invite_rival();
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
  static sim::VehicleConfig fitted_out(sim::VehicleConfig config, Random& random) {
    config.parameters = {with_gimbal(config.personality)};
    if (random.chance(0.2)) config.version = mavlink::Version::v1;
    return config;
  }

  void plan_faults() {
    for (auto count = random_.below(3); count > 0; --count) {
      const auto at = seconds{5 + random_.below(60)};
      if (random_.chance(0.3)) {
        field_.vehicle.vehicle().inject({sim::FaultKind::reboot, at, std::nullopt});
        starts_anew_ = true;
        continue;
      }
      const auto lasts = seconds{1 + random_.below(20)};
      field_.world.at(Timestamp{at}, [this, end = Timestamp{at + lasts}] { field_.world.cut(field_.link, end); });
    }
  }

  /// Another station that asks for the same, and whose answers are heard here.
  void invite_rival() {
    auto& rival = field_.world.add<StationNode>("rival", autopilot::FleetConfig{.system = mavlink::SystemId{251}});
    field_.world.connect(field_.vehicle, rival, {.delay = milliseconds{10}});
    for (int i = 0; i < 60; ++i) {
      const auto item = random_.chance(0.5) ? no_such_number : 1;
      const bool is_item = random_.chance(0.5);
      const auto number = is_item ? messages::MAV_CMD_DO_SET_MISSION_CURRENT : messages::MAV_CMD_REQUEST_MESSAGE;
      field_.world.at(Timestamp{milliseconds{random_.below(90'000)}}, [this, &rival, item, number] {
        if (rival.client() == nullptr) return;
        auto voice = rival.voice();
        static_cast<void>(rival.client()->commands().request(
            field_.world.now(), {.number = static_cast<std::uint16_t>(number), .param1 = item}, voice));
      });
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
    switch (random_.below(12)) {
      case 0: return keep(modes.arm(now, voice), true);
      case 1: return keep(modes.disarm(now, voice), false);
      case 2: return keep(modes.take_off(now, height, voice), true);
      case 3: return keep(modes.start_mission(now, voice), true);
      case 4: {
        const auto kind = kinds[random_.below(kinds.size())];
        return keep(modes.change_mode(now, kind, voice), false, kind);
      }
      case 5: return guide(voice);
      case 6: static_cast<void>(field_.client().stream().steer(now, {.north = MetresPerSecond{3}}, voice)); return;
      case 7: return point();
      default: break;
    }
    constexpr std::array commands{
        Command{.number = messages::MAV_CMD_PREFLIGHT_CALIBRATION, .param1 = 1},
        Command{.number = messages::MAV_CMD_DO_CHANGE_SPEED, .param1 = 1, .param2 = 7, .param3 = -1},
        Command{.number = messages::MAV_CMD_DO_SET_HOME, .param1 = 1},
        Command{.number = messages::MAV_CMD_RUN_PREARM_CHECKS},
        Command{.number = 42424},
        Command{.number = messages::MAV_CMD_DO_SET_MISSION_CURRENT, .param1 = 1},
        Command{.number = messages::MAV_CMD_DO_SET_MISSION_CURRENT, .param1 = no_such_number},
        Command{.number = messages::MAV_CMD_REQUEST_MESSAGE, .param1 = 0},
        Command{.number = messages::MAV_CMD_REQUEST_MESSAGE, .param1 = no_such_number},
        Command{.number = messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, .param1 = 1},
        Command{.number = messages::MAV_CMD_DO_REPOSITION,
                .x = -30.069,
                .y = -51.122,
                .z = 30,
                .frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT},
    };
    // Some at once, so that those of one number have to wait for one another.
    for (auto left = 1 + (random_.chance(0.2) ? random_.below(4) : 0); left > 0; --left)
      command(commands[random_.below(commands.size())]);
  }

  void command(const Command& command) {
    auto voice = field_.station.voice();
    const auto now = field_.world.now();
    const auto request = field_.client().commands().request(now, command, voice);
    if (!request) return;
    commands_.push_back({*request, command});
    if (command.number == messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN) starts_anew_ = true;
    if (random_.chance(0.2)) field_.client().commands().cancel(now, *request, voice);
  }

  void guide(autopilot::Voice& voice) {
    const auto now = field_.world.now();
    auto& guided = field_.client().guided();
    const auto target = displaced(config_.start, {between(random_, -90, 90), between(random_, -90, 90), 0});
    const bool is_far = random_.chance(0.5);
    const auto request = is_far ? guided.go_to(now, {target.latitude, target.longitude, {Metres{30}}}, {}, voice)
                                : guided.change_altitude(now, {Metres{25}}, voice);
    if (request) guided_.push_back(*request);
  }

  void point() {
    auto voice = field_.station.voice();
    const auto now = field_.world.now();
    auto& gimbal = field_.client().gimbal();
    auto request = gimbal.point(now, {.pitch = Radians{-0.5}}, voice);
    if (!request)
      request = gimbal.kind() == autopilot::GimbalClient::Kind::none ? gimbal.find_manager(now, voice)
                                                                     : gimbal.take_control(now, voice);
    if (request) pointed_.push_back(*request);
  }

  [[nodiscard]] std::size_t requests() const {
    return wishes_.size() + commands_.size() + guided_.size() + pointed_.size();
  }
  [[nodiscard]] std::size_t answers() const {
    std::size_t count = 0;
    for (const auto& each : field_.station.facts()) {
      const auto* command = std::get_if<CommandFact>(&each.fact);
      const bool is_progress = command != nullptr && !command->is_final();
      if (!is_progress && !std::holds_alternative<StreamFact>(each.fact)) ++count;
    }
    return count;
  }

  void judge(Totals& totals) {
    if (answers() != requests()) throw BrokenProperty{fmt::format("{} requests and {} answers", requests(), answers())};
    for (const auto& each : commands_) judge(each);
    for (const auto& each : wishes_) judge(each);
    for (const auto& each : guided_) judge<GuidedFact>(each);
    for (const auto& each : pointed_) judge<GimbalFact>(each);
    judge_clock();
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
      const bool must_be_refused = asked.command.param1 == no_such_number;
      const bool must_be_accepted = is_always_the_same(asked.command.number) && !must_be_refused;
      const bool is_refused = fact.kind == CommandFact::Kind::refused;
      if ((must_be_accepted && is_refused) || (must_be_refused && fact.kind == CommandFact::Kind::accepted))
        throw BrokenProperty{fmt::format("request {} got the answer to another", asked.id.value)};
      if (fact.attempts > 1 && !autopilot::may_be_repeated(asked.command, field_.client().peer().stack))
        throw BrokenProperty{fmt::format("command {} was sent {} times", asked.command.number, fact.attempts)};
    }
    if (finals != 1) throw BrokenProperty{fmt::format("{} answers to command {}", finals, asked.command.number)};
  }

  /// Whatever the vehicle is doing.
  static bool is_always_the_same(std::uint16_t command) {
    return command == messages::MAV_CMD_DO_SET_MISSION_CURRENT || command == messages::MAV_CMD_REQUEST_MESSAGE;
  }

  template <class Fact>
  void judge(decltype(Fact::request) wish) {
    const auto finals = std::ranges::count(field_.station.facts_of<Fact>(), wish, &Fact::request);
    if (finals != 1) throw BrokenProperty{fmt::format("{} outcomes of wish {}", finals, wish.value)};
  }

  /// The vehicle was switched on when the world began, and its clock begins with each start.
  void judge_clock() {
    const auto reading = field_.client().time_sync().best();
    if (!reading || starts_anew_) return;
    if (std::chrono::abs(reading->offset) > reading->round_trip / 2)
      throw BrokenProperty{fmt::format("the clock is wrong by {} ns", reading->offset.count())};
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
  std::vector<GuidedRequestId> guided_;
  std::vector<GimbalRequestId> pointed_;
  bool starts_anew_{};
};

TEST(ServicesSeeded, AnswerEveryCommandOnceAndTruly) {
  Totals totals;
  for_each_world(300, "services_test", [&](std::uint64_t seed) { CommandWorld{seed}.live(totals); });
  fmt::print("{} worlds, {} requests, {} of them done\n", totals.worlds, totals.requests, totals.done);
}

}  // namespace
}  // namespace ponte::world
