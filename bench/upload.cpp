// How long transfers take over an emulated serial line, in virtual time: a mission until the vehicle has it and until
// it has been read back, and all parameters. The line carries its bytes per second in each direction, 5 ms late, which
// makes the 10 ms of processing of the model; whole frames are lost. The autopilot's telemetry is switched off but for
// what each of them sends unasked now and then. Every mission is compared with what the vehicle really has.

#include "ponte/autopilot/kept_plan.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/codec.hpp"
#include "recording.hpp"
#include "support/world/station_node.hpp"
#include "support/world/vehicle_node.hpp"

#include <array>
#include <functional>
#include <set>

namespace {

using namespace ponte;
namespace messages = mavlink::autopilots;
using autopilot::WireItem;

constexpr std::chrono::milliseconds delay{5};
constexpr std::chrono::seconds start{10};  // by then both are ready
constexpr std::chrono::hours limit{1};

struct Line {
  std::uint32_t baud;
  double loss;

  [[nodiscard]] std::uint32_t bytes_per_second() const { return baud / 10; }
  [[nodiscard]] world::ChannelConfig channel() const {
    return {.delay = delay, .loss = loss, .bytes_per_second = bytes_per_second()};
  }
};

/// A vehicle and a station at the ends of a line.
class Bench {
 public:
  Bench(std::uint64_t seed, sim::Personality personality, const Line& line)
      : world_{seed, world::Timeline{false}},
        vehicle_{world_.add<world::VehicleNode>("vehicle", config(personality, line))} {
    world_.run_for(start / 2);
    silence_telemetry();
    station_ = &world_.add<world::StationNode>("station", autopilot::FleetConfig{.ask_for_streams = false});
    world_.connect(vehicle_, *station_, line.channel());
    world_.run_for(start / 2);
    PONTE_ASSERT(station_->client() != nullptr);
  }

  /// Seconds until `is_done`.
  double seconds_until(const std::function<bool()>& is_done) {
    const auto begin = world_.now();
    const bool was_done = world_.run_until(is_done, limit);
    PONTE_ASSERT(was_done);
    return std::chrono::duration<double>{world_.now() - begin}.count();
  }

  [[nodiscard]] autopilot::VehicleClient& client() { return *station_->client(); }
  [[nodiscard]] const sim::OnboardMemory& memory() const { return vehicle_.vehicle().memory(); }
  [[nodiscard]] autopilot::Voice voice() { return station_->voice(); }
  [[nodiscard]] Timestamp now() const { return world_.now(); }
  template <class Fact>
  [[nodiscard]] Fact last() const {
    return station_->facts_of<Fact>().back();
  }

 private:
  static sim::VehicleConfig config(sim::Personality personality, const Line& line) {
    return {
        .personality = personality, .fly_square = false, .line_rate = line.bytes_per_second(), .mission_items = 1001};
  }

  /// Asks for each message that the vehicle sends by itself to be left out.
  void silence_telemetry() {
    Outbox<mavlink::FrameBuffer> out{sim::Vehicle::frames_per_step};
    std::set<std::uint32_t> met;
    auto& vehicle = vehicle_.vehicle();
    const auto end = world_.now() + std::chrono::seconds{3};
    while (vehicle.next_deadline() <= end) {
      vehicle.on_tick(vehicle.next_deadline(), out);
      out.drain(
          [&](const mavlink::FrameBuffer& frame) { met.insert(mavlink::parse_frame(frame.bytes())->message.value); });
    }
    met.erase(messages::Heartbeat::info.id.value);
    for (const auto id : met) {
      std::array<std::byte, mavlink::max_frame_size> buffer{};
      const messages::CommandLong command{.target_system = 1,
                                          .target_component = 1,
                                          .command = messages::MAV_CMD_SET_MESSAGE_INTERVAL,
                                          .param1 = static_cast<float>(id),
                                          .param2 = -1};
      const auto size = mavlink::encode(command, {.system = mavlink::SystemId{255}}, buffer);
      vehicle.on_frame(end, *mavlink::parse_frame(Bytes{buffer}.first(*size)), command.info, out);
      out.drain([](const auto&) {});
    }
    world_.run_until(end);
  }

  world::World world_;
  world::VehicleNode& vehicle_;
  world::StationNode* station_{};
};

std::vector<WireItem> mission(std::size_t count) {
  std::vector<WireItem> items;
  for (std::size_t i = 0; i < count; ++i)
    items.push_back({.frame = messages::MAV_FRAME_GLOBAL_RELATIVE_ALT,
                     .command = messages::MAV_CMD_NAV_WAYPOINT,
                     .autocontinue = 1,
                     .x = -300'000'000 + static_cast<std::int32_t>(i) * 1'000,
                     .y = -511'000'000,
                     .z = 40});
  return items;
}

std::string name_of(sim::Personality personality) { return personality == sim::Personality::px4 ? "PX4" : "ArduPilot"; }

/// Both times of an upload.
struct Uploaded {
  double on_board{};
  double read_back{};
};

Uploaded upload(Bench& bench, std::size_t count) {
  const auto items = mission(count);
  auto voice = bench.voice();
  const auto started = bench.client().missions().upload(bench.now(), autopilot::PlanType::mission, items, voice);
  PONTE_ASSERT(started.has_value());
  const auto on_board = [&] { return bench.memory().missions.items(sim::PlanType::mission); };
  Uploaded times;
  times.on_board = bench.seconds_until([&] { return on_board().size() == count; });
  times.read_back = times.on_board + bench.seconds_until([&] { return !bench.client().missions().is_busy(); });
  PONTE_ASSERT(bench.last<autopilot::MissionFact>().kind == autopilot::MissionFact::Kind::uploaded);
  const auto& stack = bench.client().peer().stack;
  PONTE_ASSERT(!autopilot::first_difference(stack, autopilot::PlanType::mission, items, on_board()));
  return times;
}

void measure_missions(sim::Personality personality, std::size_t count, const Line& line) {
  const std::uint64_t rounds = line.loss == 0 ? 1 : count >= 1000 ? 5 : 50;
  Uploaded sum;
  for (std::uint64_t seed = 1; seed <= rounds; ++seed) {
    Bench bench{seed, personality, line};
    const auto times = upload(bench, count);
    sum.on_board += times.on_board;
    sum.read_back += times.read_back;
  }
  const auto what = fmt::format("{} {} {} {:.0f} %", name_of(personality), count, line.baud, line.loss * 100);
  const auto mean = [&](double total) { return total / static_cast<double>(rounds); };
  bench::print(what, mean(sum.on_board), "s");
  bench::print(what + " read back", mean(sum.read_back), "s");
}

void measure_parameters(sim::Personality personality, const Line& line) {
  constexpr std::uint64_t rounds = 5;
  double sum = 0;
  std::size_t count = 0;
  for (std::uint64_t seed = 1; seed <= rounds; ++seed) {
    Bench bench{seed, personality, line};
    auto voice = bench.voice();
    const auto started = bench.client().parameters().fetch_all(bench.now(), voice);
    PONTE_ASSERT(started.has_value());
    sum += bench.seconds_until([&] { return !bench.client().parameters().is_busy(); });
    count = bench.memory().parameters.size();
    PONTE_ASSERT(bench.client().parameters().known().size() == count);
  }
  bench::print(fmt::format("{} parameters {} {} {:.0f} %", name_of(personality), count, line.baud, line.loss * 100),
               sum / rounds, "s");
}

}  // namespace

int main() {
  for (const auto personality : {sim::Personality::ardupilot, sim::Personality::px4}) {
    for (const std::size_t count : {std::size_t{10}, std::size_t{100}, std::size_t{1000}})
      for (const std::uint32_t baud : {57600U, 115200U})
        for (const double loss : {0.0, 0.05, 0.1, 0.2}) measure_missions(personality, count, {baud, loss});
    measure_parameters(personality, {57600, 0.05});
  }
  return 0;
}
