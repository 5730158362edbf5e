// Times what the VSM adds: in this process from a frame to the DLI bytes it calls for, and over loopback UDP beside a
// relay that passes the same datagrams on untouched, by turns.

#include "loopback.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/codec.hpp"
#include "recording.hpp"
#include "vsm/live_vsm.hpp"

#include <chrono>
#include <thread>

namespace {

using namespace ponte;
using bench::Relay;
using bench::Socket;
using Clock = std::chrono::steady_clock;

constexpr int repetitions = 15;
constexpr int round_trips = 20'000;
constexpr int warm_up = 2'000;
constexpr int heartbeat_every = 500;

/// From a frame to the DLI bytes it calls for, for every frame of the recording.
bench::Times translation_times(Bytes file) {
  bench::Times times;
  for (int pass = 0; pass < repetitions; ++pass) {
    vsm::Telemetry telemetry{{}};
    Outbox<vsm::OutgoingMessage> outbox{64};
    std::optional<WallTime> first;
    bench::for_each_frame(file, [&](const mavlink::TlogRecord& record) {
      if (record.message == nullptr) return;
      if (!first) first = record.time;
      const Timestamp now{record.time - *first};
      const auto start = Clock::now();
      telemetry.on_frame(now, record.time, record.frame, *record.message, outbox);
      times.add(std::chrono::duration<double, std::nano>(Clock::now() - start).count());
      outbox.drain([](const vsm::OutgoingMessage&) {});
    });
  }
  return times;
}

/// A vehicle's frames.
class Vehicle {
 public:
  template <class M>
  Bytes frame(const M& message) {
    const mavlink::FrameHeader header{
        .system = mavlink::SystemId{1}, .component = mavlink::ComponentId{1}, .sequence = sequence_++};
    return Bytes{buffer_}.first(*mavlink::encode(message, header, buffer_));
  }

 private:
  std::uint8_t sequence_{};
  std::array<std::byte, mavlink::max_frame_size> buffer_{};
};

bool is_inertial_states(Bytes datagram) { return datagram.size() > dli::wrapper_size && u16_be(datagram, 12) == 4000; }

struct RoundTrips {
  bench::Times relayed;
  bench::Times converted;
};

/// Sends the same frames through both, by turns, and waits for each to arrive on the other side.
RoundTrips round_trip_times(std::uint16_t relay_port, const Socket& behind_relay, std::uint16_t vsm_port,
                            const Socket& behind_vsm) {
  namespace messages = mavlink::autopilots;
  RoundTrips times;
  Socket sender;
  Vehicle vehicle;
  std::array<std::byte, 2048> buffer{};
  for (int i = -warm_up; i < round_trips; ++i) {
    if (i % heartbeat_every == 0)
      sender.send(vehicle.frame(messages::Heartbeat{.type = messages::MAV_TYPE_QUADROTOR,
                                                    .autopilot = messages::MAV_AUTOPILOT_ARDUPILOTMEGA}),
                  vsm_port);
    const auto angle = static_cast<float>(i % 1000) / 1000;
    const auto frame = vehicle.frame(messages::Attitude{.roll = angle, .pitch = -angle, .yaw = angle});
    const auto start = Clock::now();
    sender.send(frame, relay_port);
    (void)behind_relay.receive(buffer);
    const auto between = Clock::now();
    sender.send(frame, vsm_port);
    while (!is_inertial_states(Bytes{buffer}.first(behind_vsm.receive(buffer)))) continue;
    const auto end = Clock::now();
    if (i < 0) continue;
    times.relayed.add(std::chrono::duration<double, std::nano>(between - start).count());
    times.converted.add(std::chrono::duration<double, std::nano>(end - between).count());
  }
  return times;
}

RoundTrips loopback_times() {
  const auto [relay_port, vsm_port] = bench::free_ports<2>();
  const Socket behind_relay;
  const Socket behind_vsm;
  vsm::BridgeConfig config;
  config.rates = vsm::TelemetryRates{};
  config.fleet.ask_for_streams = false;

  transport::Loop loop;
  const Relay relay{loop, relay_port, behind_relay.port()};
  app::LiveVsm vsm{loop, config, app::make_log({.quiet = true})};
  vsm.add_dli(transport::UdpOutEndpoint{{"127.0.0.1", behind_vsm.port()}});
  vsm.add_vehicle(transport::UdpInEndpoint{{"127.0.0.1", vsm_port}});
  std::thread worker{[&] { loop.run(); }};
  auto times = round_trip_times(relay_port, behind_relay, vsm_port, behind_vsm);
  loop.stop();
  worker.join();
  return times;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: bench_vsm FILE.tlog[.gz]\n");
    return 2;
  }
  auto translation = translation_times(app::load_file(argv[1]).bytes);
  bench::print("frame to DLI bytes p50", translation.quantile(0.5), "ns");
  bench::print("frame to DLI bytes p99", translation.quantile(0.99), "ns");
  auto loopback = loopback_times();
  bench::print("plain relay p50", loopback.relayed.quantile(0.5), "ns");
  bench::print("over loopback p50", loopback.converted.quantile(0.5), "ns");
  bench::print("plain relay p99", loopback.relayed.quantile(0.99), "ns");
  bench::print("over loopback p99", loopback.converted.quantile(0.99), "ns");
  return 0;
}
