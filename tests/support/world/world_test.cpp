#include "support/world/world.hpp"

#include "support/world/bridge_node.hpp"
#include "support/world/vehicle_node.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <set>
#include <tuple>

namespace ponte::world {
namespace {

using std::chrono::milliseconds;
using std::chrono::minutes;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Says something every second, and answers everything with one byte less.
class Talker final : public Participant {
 public:
  void on_piece(Timestamp now, Port port, Bytes piece, Sender& out) override {
    heard.emplace_back(now, port, piece.size());
    if (piece.size() > 1) out.send(port, piece.first(piece.size() - 1));
  }
  void on_tick(Timestamp now, Sender& out) override {
    out.send_to_all(std::array<std::byte, 3>{});
    next = now + seconds{1};
  }
  [[nodiscard]] std::optional<Timestamp> next_deadline() const override { return next; }

  std::optional<Timestamp> next{};
  std::vector<std::tuple<Timestamp, Port, std::size_t>> heard;
};

Timestamp at_ms(int time) { return Timestamp{milliseconds{time}}; }

TEST(World, LetsParticipantsTalkInItsOwnTime) {
  World world{1, Timeline{false}};
  auto& asking = world.add<Talker>("asking");
  auto& answering = world.add<Talker>("answering");
  asking.next = at_ms(0);
  world.connect(asking, answering, {.delay = milliseconds{10}});
  world.run_until(at_ms(1500));
  EXPECT_EQ(world.now(), at_ms(1500));
  EXPECT_THAT(answering.heard, ElementsAre(std::tuple{at_ms(10), 0U, 3U}, std::tuple{at_ms(30), 0U, 1U},
                                           std::tuple{at_ms(1010), 0U, 3U}, std::tuple{at_ms(1030), 0U, 1U}));
  EXPECT_THAT(asking.heard, ElementsAre(std::tuple{at_ms(20), 0U, 2U}, std::tuple{at_ms(1020), 0U, 2U}));
}

TEST(World, DoesWhatIsPlannedInTime) {
  World world{1, Timeline{false}};
  auto& one = world.add<Talker>("one");
  auto& other = world.add<Talker>("other");
  const auto link = world.connect(one, other, {});
  one.next = at_ms(0);
  world.at(at_ms(500), [&] { world.cut(link, at_ms(2500)); });
  world.run_until(at_ms(3500));
  EXPECT_EQ(other.heard.size(), 4U);
  EXPECT_EQ(world.counters(link).cut_off, 2U);
}

TEST(World, SaysWhenAPropertyBreaks) {
  World world{1, Timeline{false}};
  auto& one = world.add<Talker>("one");
  auto& other = world.add<Talker>("other");
  one.next = at_ms(250);
  world.connect(one, other, {});
  world.require("silence", [&]() -> std::optional<std::string> {
    if (other.heard.empty()) return {};
    return fmt::format("{} bytes were heard", std::get<2>(other.heard.front()));
  });
  try {
    world.run_for(minutes{1});
    FAIL() << "the property holds";
  } catch (const BrokenProperty& broken) {
    EXPECT_THAT(broken.what(), HasSubstr("at 0.250000 s: silence: 3 bytes were heard"));
  }
}

TEST(World, WaitsForAConditionNoLongerThanTold) {
  World world{1, Timeline{false}};
  auto& one = world.add<Talker>("one");
  auto& other = world.add<Talker>("other");
  one.next = at_ms(0);
  world.connect(one, other, {});
  EXPECT_TRUE(world.run_until([&] { return other.heard.size() > 4; }, minutes{1}));
  EXPECT_EQ(world.now(), at_ms(2000));
  EXPECT_FALSE(world.run_until([] { return false; }, seconds{10}));
  EXPECT_EQ(world.now(), at_ms(12000));
}

/// A minute of two vehicles and a VSM over bad radios.
struct Radio {
  explicit Radio(std::uint64_t seed) : world{seed} {
    const ChannelConfig radio{.delay = milliseconds{40},
                              .jitter = milliseconds{30},
                              .loss = 0.1,
                              .burst_begins = 0.002,
                              .duplication = 0.02,
                              .reordering = 0.02,
                              .bit_flips = 0.0005,
                              .bytes_per_second = 5760};
    auto& bridge = world.add<BridgeNode>("vsm");
    for (std::uint8_t system = 1; system <= 2; ++system) {
      const sim::VehicleConfig config{.system = mavlink::SystemId{system}, .seed = seed + system};
      world.connect(world.add<VehicleNode>(fmt::format("vehicle {}", system), config), bridge, radio);
    }
    world.at(Timestamp{seconds{20}}, [this] { world.cut(1, Timestamp{seconds{35}}); });
    world.run_until(Timestamp{seconds{60}});
    facts = bridge.facts();
    messages = bridge.messages();
  }
  World world;
  std::vector<autopilot::FleetFact> facts;
  std::uint64_t messages{};
};

TEST(World, IsTheSameWithTheSameSeed) {
  const Radio first{7};
  for (int i = 0; i < 9; ++i) ASSERT_EQ(Radio{7}.world.digest(), first.world.digest());
  EXPECT_NE(Radio{8}.world.digest(), first.world.digest());
}

// Whoever changes what is said takes over the new number.
TEST(World, HasTheSameBytesWithEveryCompiler) { EXPECT_EQ(Radio{7}.world.digest(), 16624802250491238991U); }

TEST(World, CarriesAVehicleToAVsmOverABadRadio) {
  using Kind = autopilot::FleetFact::Kind;
  const Radio radio{7};
  EXPECT_GT(radio.messages, 300U);
  std::multiset<std::pair<unsigned, Kind>> facts;
  for (const auto& fact : radio.facts) facts.emplace(fact.system.value, fact.kind);
  EXPECT_EQ(facts, (std::multiset<std::pair<unsigned, Kind>>{
                       {1, Kind::appeared}, {2, Kind::appeared}, {2, Kind::lost}, {2, Kind::returned}}));
}

}  // namespace
}  // namespace ponte::world
