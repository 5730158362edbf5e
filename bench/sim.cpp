// How much of a core simulated vehicles take: seconds of computing for each simulated second, of vehicles that fly in
// gusts and whose station has asked for every stream at 4 Hz. What they send is encoded, not transmitted.

#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/request_data_stream.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/sim/vehicle.hpp"
#include "recording.hpp"

#include <array>
#include <ctime>
#include <memory>
#include <vector>

namespace {

using namespace ponte;
namespace messages = mavlink::autopilots;

constexpr std::size_t vehicles = 200;
constexpr std::chrono::seconds flown{60};

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void send(const auto& message, Timestamp now, sim::Vehicle& vehicle, Outbox<mavlink::FrameBuffer>& out) {
  std::array<std::byte, mavlink::max_frame_size> buffer{};
  const auto size = mavlink::encode(message, {.system = mavlink::SystemId{255}}, buffer);
  vehicle.on_frame(now, *mavlink::parse_frame(Bytes{buffer}.first(*size)), message.info, out);
}

messages::CommandLong command(unsigned number, float param1, float param7 = 0) {
  return {.target_system = 1,
          .target_component = 1,
          .command = static_cast<std::uint16_t>(number),
          .param1 = param1,
          .param7 = param7};
}

double share(sim::Personality personality) {
  std::vector<std::unique_ptr<sim::Vehicle>> fleet;
  Outbox<mavlink::FrameBuffer> out{sim::Vehicle::frames_per_step};
  const Timestamp start{std::chrono::seconds{10}};
  for (std::uint64_t n = 0; n < vehicles; ++n) {
    auto& vehicle = *fleet.emplace_back(std::make_unique<sim::Vehicle>(sim::VehicleConfig{
        .personality = personality, .wind = {.speed = MetresPerSecond{5}, .gusts = 0.2}, .seed = n}));
    send(messages::RequestDataStream{.target_system = 1, .req_message_rate = 4, .start_stop = 1}, start, vehicle, out);
    send(command(messages::MAV_CMD_COMPONENT_ARM_DISARM, 1), start, vehicle, out);
    send(command(messages::MAV_CMD_NAV_TAKEOFF, 0, 70), start, vehicle, out);
  }
  const double before = processor_seconds();
  for (auto now = start; now < start + flown; now += sim::Airframe::step_length)
    for (const auto& each : fleet) each->on_tick(now, out);
  return (processor_seconds() - before) / std::chrono::duration<double>{flown}.count();
}

}  // namespace

int main() {
  bench::print("200 ArduPilot copters", share(sim::Personality::ardupilot), "s/s");
  bench::print("200 PX4 copters", share(sim::Personality::px4), "s/s");
  return 0;
}
