// any_command PORT NUMBER [PARAMETER...]: has a command of MAV_CMD carried out, and prints how it ended.
#include "udp_station.hpp"

int main(int argc, char** argv) {
  using namespace example;
  if (argc < 3 || argc > 10) return 2;
  UdpStation station{static_cast<std::uint16_t>(std::atoi(argv[1]))};
  const auto parameter = [&](int number) { return argc > 2 + number ? std::atof(argv[2 + number]) : 0.0; };
  const autopilot::Command command{.number = static_cast<std::uint16_t>(std::atoi(argv[2])),
                                   .param1 = static_cast<float>(parameter(1)),
                                   .param2 = static_cast<float>(parameter(2)),
                                   .param3 = static_cast<float>(parameter(3)),
                                   .param4 = static_cast<float>(parameter(4)),
                                   .x = parameter(5),
                                   .y = parameter(6),
                                   .z = static_cast<float>(parameter(7))};
  auto& commands = station.vehicle().commands();
  const auto fact = station.carry_out<autopilot::CommandFact>(
      [&](Timestamp now, autopilot::Voice& voice) { return commands.request(now, command, voice); });
  if (fact.kind != autopilot::CommandFact::Kind::accepted) give_up("not accepted");
  std::printf("accepted after %d messages\n", int{fact.attempts});
}
