#include "ponte/mavlink/router.hpp"

#include "ponte/core/random.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/test_messages.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>

namespace ponte::mavlink {
namespace {

using namespace std::chrono_literals;

constexpr std::array<FieldInfo, 1> fields{{{"target_system", FieldType::uint8, 0, 1, false, "", "", nullptr}}};
constexpr MessageInfo addressed{MessageId{4}, "ADDRESSED", 237, 3, 3, fields};
constexpr MessageInfo shell{MessageId{126}, "SERIAL_CONTROL", 220, 3, 3, fields};

/// The routing rules once more, in the plainest form.
class Model {
 public:
  void add(std::uint16_t link, bool untrusted) { untrusted_[link] = untrusted; }
  void remove(std::uint16_t link) {
    untrusted_.erase(link);
    std::erase_if(heard_, [&](const auto& entry) { return entry.first.first == link; });
  }
  std::set<std::uint16_t> route(Timestamp now, std::uint16_t from, unsigned system, unsigned target, bool risky) {
    std::set<std::uint16_t> to;
    if (risky && untrusted_.at(from)) return to;
    heard_[{from, system}] = now;
    for (const auto& [link, untrusted] : untrusted_) {
      const auto heard = heard_.find({link, target});
      const bool is_there = heard != heard_.end() && now - heard->second < 60s;
      if (link != from && (target == 0 || is_there) && !(risky && untrusted)) to.insert(link);
    }
    return to;
  }
  [[nodiscard]] const std::map<std::uint16_t, bool>& links() const { return untrusted_; }

 private:
  std::map<std::uint16_t, bool> untrusted_;
  std::map<std::pair<std::uint16_t, unsigned>, Timestamp> heard_;
};

TEST(RouterSeeded, RoutesRandomFramesOfManyLinksAsTheModelDoes) {
  Random random{chosen_seed()};
  Router router{random.next()};
  Model model;
  Timestamp now{};
  std::uint16_t last_link = 0;
  std::uint64_t routed = 0;
  for (std::uint32_t round = 0; round < 100'000; ++round) {
    now += std::chrono::milliseconds{random.below(round % 1000 == 0 ? 70'000 : 20)};
    if (model.links().size() < 2 || (random.chance(0.01) && model.links().size() < 20)) {
      const bool untrusted = random.chance(0.3);
      ASSERT_TRUE(router.add_link(RouteLinkId{++last_link}, {.untrusted = untrusted}));
      model.add(last_link, untrusted);
      continue;
    }
    const auto chosen =
        std::next(model.links().begin(), random.below(static_cast<std::uint32_t>(model.links().size())));
    const auto from = chosen->first;
    if (random.chance(0.008)) {
      router.remove_link(RouteLinkId{from});
      model.remove(from);
      continue;
    }
    const auto system = 1 + random.below(30);
    const auto target = random.chance(0.3) ? 0 : 1 + random.below(30);
    const auto& message = random.chance(0.2) ? shell : addressed;
    // The first byte and the sequence make every frame of the window another.
    const std::array<std::byte, 3> payload{static_cast<std::byte>(round >> 8U), static_cast<std::byte>(target),
                                           static_cast<std::byte>(round >> 16U)};
    std::array<std::byte, max_frame_size> frame{};
    const FrameHeader header{.version = random.chance(0.5) ? Version::v1 : Version::v2,
                             .system = SystemId{static_cast<std::uint8_t>(system)},
                             .sequence = static_cast<std::uint8_t>(round)};
    const auto size = write_frame(header, message, payload, frame).value();
    const auto targets =
        router.on_frame(now, RouteLinkId{from}, parse_frame(Bytes{frame}.first(size)).value(), &message);

    std::set<std::uint16_t> found;
    for (const auto link : targets) EXPECT_TRUE(found.insert(link.value).second) << "twice to one link";
    ASSERT_EQ(found, model.route(now, from, system, target, &message == &shell)) << "round " << round;
    routed += found.size();
  }
  EXPECT_GT(routed, 100'000U);
}

/// Routers joined in a ring, and twice with one another: a frame reaches each of them, and then comes to rest.
TEST(RouterSeeded, LoopsComeToRest) {
  struct Wire {
    std::size_t router;
    std::uint16_t link;
  };
  constexpr std::size_t count = 5;
  Random random{chosen_seed()};
  std::vector<std::unique_ptr<Router>> routers;
  for (std::size_t i = 0; i < count; ++i) routers.push_back(std::make_unique<Router>(random.next()));
  std::map<std::pair<std::size_t, std::uint16_t>, Wire> wires;
  std::uint16_t number = 0;
  const auto join = [&](std::size_t one, std::size_t other) {
    const auto left = ++number;
    const auto right = ++number;
    ASSERT_TRUE(routers[one]->add_link(RouteLinkId{left}, {}));
    ASSERT_TRUE(routers[other]->add_link(RouteLinkId{right}, {}));
    wires[{one, left}] = {other, right};
    wires[{other, right}] = {one, left};
  };
  for (std::size_t i = 0; i < count; ++i) {
    join(i, (i + 1) % count);
    join(i, (i + 1) % count);
  }
  const auto vehicle = ++number;
  ASSERT_TRUE(routers[0]->add_link(RouteLinkId{vehicle}, {}));

  for (std::uint8_t sequence = 0; sequence < 100; ++sequence) {
    std::array<std::byte, max_frame_size> frame{};
    const auto size = encode(testing::Heartbeat{}, {.system = SystemId{1}, .sequence = sequence}, frame).value();
    const auto view = parse_frame(Bytes{frame}.first(size)).value();
    std::vector<Wire> under_way{{0, vehicle}};
    std::set<std::size_t> reached;
    std::size_t hops = 0;
    while (!under_way.empty()) {
      const auto at = random.below(static_cast<std::uint32_t>(under_way.size()));
      const auto arrival = under_way[at];
      under_way.erase(under_way.begin() + at);
      ASSERT_LT(++hops, 1000U) << "it goes round and round";
      const auto targets =
          routers[arrival.router]->on_frame(Timestamp{}, RouteLinkId{arrival.link}, view, &testing::Heartbeat::info);
      if (!targets.empty()) reached.insert(arrival.router);
      for (const auto link : targets)
        if (const auto wire = wires.find({arrival.router, link.value}); wire != wires.end())
          under_way.push_back(wire->second);
    }
    EXPECT_EQ(reached.size(), count);
  }
}

}  // namespace
}  // namespace ponte::mavlink
