// How much faster than real time a world goes, with one vehicle in flight and one VSM that listens to it over a radio.

#include "ponte/core/assert.hpp"
#include "recording.hpp"
#include "support/world/bridge_node.hpp"
#include "support/world/vehicle_node.hpp"

#include <ctime>

namespace {

using namespace ponte;

constexpr std::chrono::minutes flown{10};
constexpr int repetitions = 5;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

void fly() {
  world::World world{1, world::Timeline{false}};
  const auto& bridge = world.add<world::BridgeNode>("vsm");
  const auto& vehicle = world.add<world::VehicleNode>("vehicle", sim::VehicleConfig{});
  world.connect(vehicle, bridge, {.delay = std::chrono::milliseconds{20}, .loss = 0.05});
  world.run_for(flown);
  PONTE_ASSERT(bridge.messages() > 0);
}

}  // namespace

int main() {
  bench::Times times;
  for (int i = 0; i < repetitions; ++i) {
    const auto begin = processor_seconds();
    fly();
    times.add(processor_seconds() - begin);
  }
  bench::print("virtual time", std::chrono::duration<double>{flown}.count() / times.quantile(0.5), "x real");
  return 0;
}
