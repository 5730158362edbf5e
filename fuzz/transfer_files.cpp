// The files that transfers read: saved parameters, ArduPilot's packed parameters and plans; and plans as they are
// transferred. The first byte chooses. What is read has to be written as what is read again.

#include "ponte/autopilot/parameter_file.hpp"
#include "ponte/autopilot/parameter_pack.hpp"
#include "ponte/autopilot/plan_file.hpp"
#include "ponte/core/assert.hpp"

#include <algorithm>
#include <cstdint>

namespace {

using namespace ponte;
using namespace ponte::autopilot;

void read_saved(Bytes input) {
  const auto lines = read_parameter_file(input);
  if (!lines) return;
  std::vector<Parameter> parameters;
  for (const auto& each : *lines)
    parameters.push_back({each.name, each.type.value_or(ParameterType::real32), each.value});
  // Names that different components share come twice then.
  const auto text = write_qgroundcontrol_file(parameters, 1, 1);
  (void)read_parameter_file(bytes_of(text));
  (void)write_mavproxy_file(parameters);
}

void read_plan(unsigned choice, Bytes input) {
  const auto type = static_cast<PlanType>(choice % plan_types);
  const auto items = unpack_plan(type, input);
  if (!items) return;
  PONTE_ASSERT(pack_plan(type, *items).size() == input.size());
  for (const auto stack : {Stack::ardupilot_copter, Stack::px4}) {
    vehicle::Mission mission;
    if (!from_wire(stack, type, *items, mission)) continue;
    (void)to_wire(stack, type, mission);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Bytes input = std::as_bytes(std::span{data, size});
  if (input.empty()) return 0;
  const unsigned choice = u8(input, 0);
  const auto rest = input.subspan(1);
  switch (choice % 5) {
    case 0: read_saved(rest); break;
    case 1: (void)unpack_parameters(rest); break;
    default: read_plan(choice, rest);
  }
  return 0;
}
