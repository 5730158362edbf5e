// set_parameter PORT NAME VALUE: sets a parameter, and prints what the vehicle has then.
#include "udp_station.hpp"

int main(int argc, char** argv) {
  using namespace example;
  if (argc != 4) return 2;
  UdpStation station{static_cast<std::uint16_t>(std::atoi(argv[1]))};
  auto& parameters = station.vehicle().parameters();
  const auto fact = station.carry_out<autopilot::ParameterFact>(
      [&](Timestamp now, autopilot::Voice& voice) { return parameters.set(now, argv[2], std::atof(argv[3]), voice); });
  if (fact.kind != autopilot::ParameterFact::Kind::set) give_up("it is not set");
  std::printf("%s is %g\n", argv[2], fact.parameter.value);
}
