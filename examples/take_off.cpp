// take_off PORT HEIGHT: takes off, whatever the autopilot, and returns home.
#include "udp_station.hpp"

#include "ponte/vehicle/vocabulary.hpp"

int main(int argc, char** argv) {
  using namespace example;
  if (argc != 3) return 2;
  UdpStation station{static_cast<std::uint16_t>(std::atoi(argv[1]))};
  const ponte::Metres height{std::atof(argv[2])};
  auto& modes = station.vehicle().modes();
  using Kind = autopilot::ModeFact::Kind;
  const auto take_off = [&](Timestamp now, autopilot::Voice& voice) { return modes.take_off(now, height, voice); };
  auto took_off = station.carry_out<autopilot::ModeFact>(take_off);
  for (int again = 0; took_off.kind == Kind::refused && again < 30; ++again) {
    station.wait(std::chrono::seconds{1});  // until its checks pass
    took_off = station.carry_out<autopilot::ModeFact>(take_off);
  }
  if (took_off.kind != Kind::done) give_up(took_off.reason.view());
  std::puts("in the air");
  const auto returns = station.carry_out<autopilot::ModeFact>([&](Timestamp now, autopilot::Voice& voice) {
    return modes.change_mode(now, ponte::vehicle::ModeKind::return_home, voice);
  });
  if (returns.kind != Kind::done) give_up("it does not return");
  std::puts("on its way home");
}
