#include "support/world/seeded.hpp"
#include "support/world/transfer_node.hpp"
#include "support/world/vehicle_node.hpp"

#include "ponte/autopilot/kept_plan.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <array>

// Transfers between a station and a vehicle, over radios that are as good or bad as the seed wants them.
namespace ponte::world {
namespace {

namespace messages = mavlink::autopilots;
using autopilot::MissionFact;
using autopilot::PlanType;
using autopilot::Stack;
using autopilot::WireItem;
using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;

Stack stack_of(const sim::VehicleConfig& vehicle) {
  if (vehicle.personality == sim::Personality::px4) return Stack::px4;
  return vehicle.type == sim::AirframeType::plane ? Stack::ardupilot_plane : Stack::ardupilot_copter;
}

WireItem item(Random& random, std::uint16_t command) {
  WireItem result{.frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT, .command = command, .autocontinue = 1};
  result.x = -300'000'000 + static_cast<std::int32_t>(random.below(1'000'000));
  result.y = -511'000'000 + static_cast<std::int32_t>(random.below(1'000'000));
  result.z = static_cast<float>(random.below(10'000)) / 100;
  return result;
}

std::vector<WireItem> random_plan(Random& random, PlanType type) {
  constexpr std::array<std::uint32_t, autopilot::plan_types> longest{40, 25, 12};
  std::vector<WireItem> items;
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

struct Totals {
  int worlds{};
  int requests{};
  int uploaded{};
  int failed{};
  std::array<int, 7> failures{};  // by reason
  int faults{};
};

/// A station that makes one request after the other, and a second one that sometimes does so at the same time.
class TransferWorld {
 public:
  explicit TransferWorld(std::uint64_t seed) : world_{seed}, random_{seed} {
    config_.fly_square = false;
    config_.personality = random_.chance(0.5) ? sim::Personality::px4 : sim::Personality::ardupilot;
    if (config_.personality == sim::Personality::ardupilot && random_.chance(0.3))
      config_.type = sim::AirframeType::plane;
    config_.version = random_.chance(0.2) ? mavlink::Version::v1 : mavlink::Version::v2;
    vehicle_ = &world_.add<VehicleNode>("vehicle", config_);
    const autopilot::Peer peer{config_.system, config_.component, stack_of(config_)};
    station_ = &world_.add<TransferNode>("station", peer, mavlink::SystemId{255}, config_.version);
    link_ = world_.connect(*vehicle_, *station_, random_radio(random_));
    if (random_.chance(0.3)) {
      other_ = &world_.add<TransferNode>("other", peer, mavlink::SystemId{254}, config_.version);
      world_.connect(*vehicle_, *other_, random_radio(random_));
    }
    plan_faults();
    world_.run_for(seconds{1});
  }

  void happen(Totals& totals) {
    ++totals.worlds;
    totals.faults += faults_;
    for (auto count = 3 + random_.below(4); count > 0; --count) {
      if (other_ != nullptr && !other_->is_busy() && random_.chance(0.5)) other_->ask(random_request(*other_));
      const auto facts_before = station_->mission_facts().size();
      const auto type = random_type();
      station_->ask(random_request(*station_, type));
      world_.run_for(milliseconds{1});
      // The bound of a transfer of this length, begun anew and put back.
      if (!world_.run_until([this] { return !station_->is_busy(); }, minutes{60}))
        throw BrokenProperty{"a request has no end"};
      const auto& facts = station_->mission_facts();
      if (facts.size() != facts_before + 1)
        throw BrokenProperty{fmt::format("a request has {} answers", facts.size() - facts_before)};
      ++totals.requests;
      examine(facts.back(), totals);
    }
  }

 private:
  PlanType random_type() {
    if (config_.version == mavlink::Version::v1) return PlanType::mission;
    return static_cast<PlanType>(random_.below(autopilot::plan_types));
  }

  TransferNode::Work random_request(TransferNode& node) { return random_request(node, random_type()); }
  TransferNode::Work random_request(TransferNode& node, PlanType type) {
    auto& missions = node.missions();
    const auto choice = random_.below(10);
    if (choice < 6) {
      if (!random_.chance(0.15)) plan_ = random_plan(random_, type);
      if (type != type_of_plan_) plan_ = random_plan(random_, type);
      type_of_plan_ = type;
      return [&missions, type, plan = plan_](Timestamp now, autopilot::Voice& voice) {
        (void)missions.upload(now, type, plan, voice);
      };
    }
    if (choice < 8)
      return [&missions, type](Timestamp now, autopilot::Voice& voice) { (void)missions.download(now, type, voice); };
    if (choice < 9)
      return [&missions, type](Timestamp now, autopilot::Voice& voice) { (void)missions.clear(now, type, voice); };
    return [&missions](Timestamp now, autopilot::Voice& voice) { (void)missions.set_current(now, 0, voice); };
  }

  void examine(const MissionFact& fact, Totals& totals) const {
    const auto on_board = vehicle_->vehicle().memory().missions.items(static_cast<sim::PlanType>(fact.type));
    // Another station may have changed it in the meantime.
    const bool is_ours_alone = other_ == nullptr;
    const auto expect_on_board = [&](std::span<const WireItem> plan, std::string_view what) {
      if (!is_ours_alone) return;
      const auto wrong = autopilot::first_difference(stack_of(config_), fact.type, plan, on_board);
      if (wrong) throw BrokenProperty{fmt::format("{}, but item {} on board differs", what, *wrong)};
    };
    switch (fact.kind) {
      case MissionFact::Kind::uploaded:
        ++totals.uploaded;
        expect_on_board(plan_, "uploaded");
        break;
      case MissionFact::Kind::cleared: expect_on_board({}, "cleared"); break;
      case MissionFact::Kind::downloaded: {
        const auto* plan = station_->missions().plan(fact.type);
        if (is_ours_alone && plan == nullptr) throw BrokenProperty{"what was downloaded is not known"};
        if (plan != nullptr) expect_on_board(*plan, "downloaded");
        break;
      }
      case MissionFact::Kind::failed:
        ++totals.failed;
        ++totals.failures[static_cast<std::size_t>(fact.failure)];
        break;
      default: break;
    }
  }

  void plan_faults() {
    for (auto count = random_.below(3); count > 0; --count) {
      ++faults_;
      const auto at = seconds{2 + random_.below(60)};
      if (random_.chance(0.6)) {
        const auto lasts = seconds{1 + random_.below(40)};
        world_.at(Timestamp{at}, [this, end = Timestamp{at + lasts}] { world_.cut(link_, end); });
      } else {
        vehicle_->vehicle().inject({sim::FaultKind::reboot, at, std::nullopt});
        world_.at(Timestamp{at + seconds{2}}, [this] { station_->reboot(); });
      }
    }
  }

  World world_;
  Random random_;
  sim::VehicleConfig config_;
  VehicleNode* vehicle_{};
  TransferNode* station_{};
  TransferNode* other_{};
  std::vector<WireItem> plan_;  // that was uploaded last
  PlanType type_of_plan_{};
  std::size_t link_{};
  int faults_{};
};

TEST(TransfersSeeded, EndOnceAndTellTheTruth) {
  Totals totals;
  run_worlds(world_count(300), "transfers_test", [&](std::uint64_t seed) { TransferWorld{seed}.happen(totals); });
  fmt::print("{} worlds, {} requests, {} uploaded, {} failed, {} faults; failures by reason: {}\n", totals.worlds,
             totals.requests, totals.uploaded, totals.failed, totals.faults, fmt::join(totals.failures, " "));
  EXPECT_LE(10 * totals.failed, totals.requests + 100) << "most radios are good enough";
}

}  // namespace
}  // namespace ponte::world
