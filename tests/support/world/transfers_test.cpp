#include "support/world/random_world.hpp"
#include "support/world/station_node.hpp"
#include "support/world/vehicle_node.hpp"

#include "ponte/autopilot/kept_plan.hpp"
#include "ponte/autopilot/parameter_pack.hpp"
#include "ponte/autopilot/plan_file.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

// Transfers of plans, parameters and files between a station and a vehicle, over radios that are as good or bad as the
// seed wants them.
namespace ponte::world {
namespace {

namespace messages = mavlink::autopilots;
using autopilot::FileFact;
using autopilot::MissionFact;
using autopilot::Parameter;
using autopilot::ParameterFact;
using autopilot::PlanType;
using autopilot::WireItem;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;
using Plan = std::vector<WireItem>;

WireItem item(Random& random, unsigned command) {
  WireItem result{.frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT,
                  .command = static_cast<std::uint16_t>(command),
                  .autocontinue = 1};
  result.x = -300'000'000 + static_cast<std::int32_t>(random.below(1'000'000));
  result.y = -511'000'000 + static_cast<std::int32_t>(random.below(1'000'000));
  result.z = static_cast<float>(random.below(10'000)) / 100;
  return result;
}

Plan random_plan(Random& random, PlanType type) {
  constexpr std::array<std::uint32_t, autopilot::plan_types> longest{40, 25, 12};
  Plan items;
  const auto count = random.below(longest[static_cast<std::size_t>(type)]);
  while (items.size() < count) {
    switch (type) {
      case PlanType::mission:
        items.push_back(item(random, messages::MAV_CMD_NAV_WAYPOINT));
        items.back().param1 = static_cast<float>(random.below(20)) / 2;
        if (random.chance(0.2)) {
          items.push_back({.frame = 2, .command = messages::MAV_CMD_DO_CHANGE_SPEED, .autocontinue = 1, .param1 = 1});
          items.back().param2 = static_cast<float>(random.below(100)) / 8;
        }
        break;
      case PlanType::fence:
        items.push_back(item(random, messages::MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION));
        items.back().param1 = static_cast<float>(10 + random.below(90));
        break;
      case PlanType::rally: items.push_back(item(random, messages::MAV_CMD_NAV_RALLY_POINT)); break;
    }
  }
  return items;
}

/// What the requests of all worlds came to: how often each outcome.
using Tally = std::map<std::string, int>;

/// A vehicle, and a station that makes one request after the other.
class TransferWorld {
 public:
  TransferWorld(std::uint64_t seed, Tally& tally, bool is_ardupilot = false)
      : world_{seed}, random_{seed}, tally_{tally} {
    do config_ = random_vehicle(random_);
    while (is_ardupilot && config_.personality != sim::Personality::ardupilot);
    if (random_.chance(0.2)) config_.version = mavlink::Version::v1;
    vehicle_ = &world_.add<VehicleNode>("vehicle", config_);
    station_ = &add_station("station", 250, link_);
  }
  virtual ~TransferWorld() = default;

  void happen() {
    meet(*station_);
    plan_faults();
    for (auto count = 3 + random_.below(4); count > 0; --count) {
      const auto facts_before = final_facts();
      make_request();
      // Longer than any transfer may take that is begun anew and put back.
      if (!world_.run_until([this] { return !is_busy(); }, minutes{60})) throw BrokenProperty{"a request has no end"};
      if (final_facts() != facts_before + 1)
        throw BrokenProperty{fmt::format("a request has {} answers", final_facts() - facts_before)};
      examine();
    }
  }

 protected:
  virtual void make_request() = 0;
  [[nodiscard]] virtual bool is_busy() = 0;
  /// Examines the outcome of the last request.
  virtual void examine() = 0;
  [[nodiscard]] virtual std::size_t final_facts() const = 0;

  StationNode& add_station(std::string name, std::uint8_t system, std::size_t& link) {
    auto& station = world_.add<StationNode>(std::move(name), autopilot::FleetConfig{.system = mavlink::SystemId{system},
                                                                                    .version = config_.version,
                                                                                    .ask_for_streams = false});
    link = world_.connect(*vehicle_, station, random_radio(random_));
    return station;
  }
  void meet(StationNode& station) {
    if (!world_.run_until([&] { return station.client() != nullptr; }, minutes{1}))
      throw BrokenProperty{"the vehicle is not heard"};
  }

  template <class Fact>
  [[nodiscard]] std::vector<Fact> ends_of() const {
    auto facts = station_->facts_of<Fact>();
    std::erase_if(facts, [](const Fact& fact) { return fact.kind == Fact::Kind::progress; });
    return facts;
  }

  void count(const std::string& outcome) { ++tally_[outcome]; }
  [[nodiscard]] autopilot::VehicleClient& client() const { return *station_->client(); }
  [[nodiscard]] const sim::OnboardMemory& memory() const { return vehicle_->vehicle().memory(); }
  [[nodiscard]] std::span<const WireItem> on_board(PlanType type) const {
    return memory().missions.items(static_cast<sim::PlanType>(type));
  }
  void expect_on_board(PlanType type, std::span<const WireItem> plan, std::string_view what) const {
    const auto wrong = autopilot::first_difference(client().peer().stack, type, plan, on_board(type));
    if (wrong) throw BrokenProperty{fmt::format("{}, but item {} on board differs", what, *wrong)};
  }

  World world_;
  Random random_;
  sim::VehicleConfig config_;
  VehicleNode* vehicle_{};
  StationNode* station_{};
  std::size_t link_{};

 private:
  void plan_faults() {
    for (auto faults = random_.below(3); faults > 0; --faults) {
      const auto at = world_.now() + seconds{2 + random_.below(60)};
      if (random_.chance(0.6)) {
        const auto lasts = seconds{1 + random_.below(40)};
        world_.at(at, [this, end = at + lasts] { world_.cut(link_, end); });
        continue;
      }
      vehicle_->vehicle().inject({sim::FaultKind::reboot, at - Timestamp{}, std::nullopt});
      // Without streams there is no clock that would tell.
      world_.at(at + seconds{2}, [this] { client().on_reboot(world_.now(), reboot_facts_); });
    }
  }

  Tally& tally_;
  Outbox<autopilot::VehicleFact> reboot_facts_{16};
};

/// Missions, fences and rally points; sometimes another station does the same at the same time.
class PlanWorld final : public TransferWorld {
 public:
  PlanWorld(std::uint64_t seed, Tally& tally) : TransferWorld{seed, tally} {
    std::size_t link{};
    if (random_.chance(0.3)) other_ = &add_station("other", 251, link);
  }

 private:
  void make_request() override {
    if (other_ != nullptr && other_->client() != nullptr && !other_->client()->missions().is_busy() &&
        random_.chance(0.5)) {
      auto voice = other_->voice();
      const auto type = random_type();
      (void)other_->client()->missions().upload(world_.now(), type, random_plan(random_, type), voice);
    }
    auto voice = station_->voice();
    auto& missions = client().missions();
    const auto choice = random_.below(10);
    const auto type = choice == 9 ? PlanType::mission : random_type();
    if (choice < 6 && (type != type_ || !random_.chance(0.15))) plan_ = random_plan(random_, type);
    if (choice < 6) type_ = type;
    switch (choice) {
      case 6:
      case 7: (void)missions.download(world_.now(), type, voice); break;
      case 8: (void)missions.clear(world_.now(), type, voice); break;
      case 9: (void)missions.set_current(world_.now(), 0, voice); break;
      default: (void)missions.upload(world_.now(), type, plan_, voice);
    }
  }
  [[nodiscard]] bool is_busy() override { return client().missions().is_busy(); }
  [[nodiscard]] std::size_t final_facts() const override { return ends_of<MissionFact>().size(); }

  void examine() override {
    const auto fact = ends_of<MissionFact>().back();
    const bool is_alone = other_ == nullptr;  // or it may have been changed in the meantime
    switch (fact.kind) {
      case MissionFact::Kind::uploaded:
        count("uploaded");
        if (is_alone) expect_on_board(fact.type, plan_, "uploaded");
        break;
      case MissionFact::Kind::cleared:
        count("cleared");
        if (is_alone) expect_on_board(fact.type, {}, "cleared");
        break;
      case MissionFact::Kind::downloaded: {
        count("downloaded");
        const auto* plan = client().missions().plan(fact.type);
        if (is_alone && plan == nullptr) throw BrokenProperty{"what was downloaded is not known"};
        if (is_alone) expect_on_board(fact.type, *plan, "downloaded");
        break;
      }
      case MissionFact::Kind::failed:
        count(fmt::format("failed {}", static_cast<int>(fact.failure)));
        if (is_alone && fact.plan == autopilot::PlanOnBoard::restored)
          expect_on_board(fact.type, *client().missions().plan(fact.type), "restored");
        break;
      default: count("current set");
    }
  }

  PlanType random_type() {
    if (config_.version == mavlink::Version::v1) return PlanType::mission;
    return static_cast<PlanType>(random_.below(autopilot::plan_types));
  }

  StationNode* other_{};
  Plan plan_;  // that was uploaded last
  PlanType type_{};
};

class ParameterWorld final : public TransferWorld {
 public:
  using TransferWorld::TransferWorld;

 private:
  void make_request() override {
    auto voice = station_->voice();
    auto& parameters = client().parameters();
    const auto& table = memory().parameters;
    const auto& any = table.info(random_.below(static_cast<std::uint32_t>(table.size())));
    switch (random_.below(6)) {
      case 0:
      case 1: (void)parameters.fetch_all(world_.now(), voice); break;
      case 2: (void)parameters.get(world_.now(), any.name, voice); break;
      case 3: (void)parameters.get(world_.now(), "NO_SUCH_NAME", voice); break;
      default: (void)parameters.set(world_.now(), any.name, static_cast<double>(random_.below(100)), voice);
    }
  }
  [[nodiscard]] bool is_busy() override { return client().parameters().is_busy(); }
  [[nodiscard]] std::size_t final_facts() const override { return ends_of<ParameterFact>().size(); }

  /// What the vehicle counts by itself changes while it is told.
  [[nodiscard]] static bool is_counted(std::string_view name) {
    return name.starts_with("STAT_") || name.ends_with("_TOTAL");
  }
  void expect_on_board(const Parameter& parameter, std::string_view what) const {
    const auto& table = memory().parameters;
    const auto index = table.find(parameter.name.view());
    if (!index) throw BrokenProperty{fmt::format("{} is {}, but not on board", parameter.name.view(), what)};
    const auto is = static_cast<float>(table.value(*index));
    if (is != static_cast<float>(parameter.value) && !is_counted(parameter.name.view()))
      throw BrokenProperty{
          fmt::format("{} is {} as {}, but on board it is {}", parameter.name.view(), what, parameter.value, is)};
  }

  void examine() override {
    const auto fact = ends_of<ParameterFact>().back();
    switch (fact.kind) {
      case ParameterFact::Kind::fetched: {
        count(fact.was_known ? "fetched by hash" : "fetched");
        const auto known = client().parameters().known();
        if (known.size() != memory().parameters.size())
          throw BrokenProperty{fmt::format("{} of {} are fetched", known.size(), memory().parameters.size())};
        for (const auto& each : known) expect_on_board(each, "fetched");
        break;
      }
      case ParameterFact::Kind::got:
        count("got");
        expect_on_board(fact.parameter, "told");
        break;
      case ParameterFact::Kind::set:
        count("set");
        expect_on_board(fact.parameter, "set");
        break;
      default: count(fmt::format("failed {}", static_cast<int>(fact.failure)));
    }
  }
};

/// ArduPilot's virtual files.
class FileWorld final : public TransferWorld {
 public:
  FileWorld(std::uint64_t seed, Tally& tally) : TransferWorld{seed, tally, true} {}

 private:
  void make_request() override {
    auto voice = station_->voice();
    auto& files = client().files();
    const auto now = world_.now();
    type_ = static_cast<PlanType>(random_.below(autopilot::plan_types));
    request_ = random_.below(5);
    switch (request_) {
      case 0: (void)files.read(now, "@PARAM/param.pck", voice); break;
      case 1: (void)files.read(now, autopilot::plan_path(type_), voice); break;
      case 2:
        plan_ = random_plan(random_, type_);
        (void)files.write(now, autopilot::plan_path(type_), autopilot::pack_plan(type_, plan_), voice);
        break;
      case 3: (void)files.list(now, "@MISSION", voice); break;
      default: (void)files.checksum(now, "@PARAM/param.pck", voice);
    }
  }
  [[nodiscard]] bool is_busy() override { return client().files().is_busy(); }
  [[nodiscard]] std::size_t final_facts() const override { return ends_of<FileFact>().size(); }

  void examine() override {
    const auto fact = ends_of<FileFact>().back();
    switch (fact.kind) {
      case FileFact::Kind::was_read:
        count("read");
        if (request_ == 0)
          examine_parameters();
        else
          expect_on_board(type_, autopilot::unpack_plan(type_, client().files().content()).value(), "read");
        break;
      case FileFact::Kind::written:
        count("written");
        expect_on_board(type_, plan_, "written");
        break;
      case FileFact::Kind::listed:
        count("listed");
        if (client().files().entries().size() != autopilot::plan_types)
          throw BrokenProperty{fmt::format("{} files are listed", client().files().entries().size())};
        break;
      case FileFact::Kind::checksum: count("checksum"); break;
      default: count(fmt::format("failed {}", static_cast<int>(fact.failure)));
    }
  }

  void examine_parameters() {
    const auto parameters = autopilot::unpack_parameters(client().files().content());
    if (!parameters || parameters->size() != memory().parameters.size())
      throw BrokenProperty{"the packed parameters cannot be read"};
    for (std::size_t i = 0; i < parameters->size(); ++i)
      if ((*parameters)[i].name.view() != memory().parameters.info(i).name)
        throw BrokenProperty{fmt::format("parameter {} has another name", i)};
  }

  PlanType type_{};
  std::uint32_t request_{};
  Plan plan_;
};

template <class W>
Tally run(int usual) {
  Tally tally;
  for_each_world(usual, "transfers_test", [&](std::uint64_t seed) { W{seed, tally}.happen(); });
  for (const auto& [outcome, times] : tally) fmt::print("{}: {}\n", outcome, times);
  return tally;
}

TEST(PlanTransfersSeeded, EndOnceAndTellTheTruth) { (void)run<PlanWorld>(150); }
TEST(ParameterTransfersSeeded, EndOnceAndTellTheTruth) { (void)run<ParameterWorld>(100); }
TEST(FileTransfersSeeded, EndOnceAndTellTheTruth) { (void)run<FileWorld>(50); }

}  // namespace
}  // namespace ponte::world
