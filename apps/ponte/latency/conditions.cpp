#include "latency/conditions.hpp"

#include <fmt/format.h>

#include <sys/utsname.h>

#include <fstream>
#include <string>
#include <thread>

namespace ponte::app {
namespace {

/// The board's or the processor's name as the kernel tells it; empty where it does not.
std::string machine_name() {
  std::ifstream file{"/proc/cpuinfo"};
  std::string name;
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(": ");
    const bool is_board = line.starts_with("Model\t");  // comes last
    if (colon != std::string::npos && (is_board || (line.starts_with("model name\t") && name.empty())))
      name = line.substr(colon + 2);
  }
  return name;
}

}  // namespace

std::vector<vsm::LatencyCondition> conditions_of_this_machine() {
  utsname system{};
  ::uname(&system);
  const auto name = machine_name();
  return {
      {"host", system.nodename},
      {"processor", fmt::format("{} x {}", std::thread::hardware_concurrency(), name.empty() ? system.machine : name)},
      {"kernel", fmt::format("{} {} {}", system.sysname, system.release, system.machine)},
      {"ponte", PONTE_VERSION},
      {"compiler", PONTE_COMPILER}};
}

}  // namespace ponte::app
