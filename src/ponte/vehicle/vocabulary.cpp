#include "ponte/vehicle/vocabulary.hpp"

#include <array>

namespace ponte::vehicle {
namespace {

template <std::size_t Count, class E>
std::string_view look_up(const std::array<std::string_view, Count>& names, E value) {
  return names[static_cast<std::size_t>(value)];
}

}  // namespace

std::string_view name_of(ModeKind kind) {
  static constexpr std::array<std::string_view, 11> names{"none",         "manual",      "mission",  "hold",
                                                          "guided",       "land",        "take_off", "return_home",
                                                          "smart_return", "vtol_return", "other"};
  return look_up(names, kind);
}

std::string_view name_of(Phase phase) {
  static constexpr std::array<std::string_view, 8> names{"unknown",    "power_up",  "pre_start", "pre_launch",
                                                         "taking_off", "in_flight", "landing",   "critical"};
  return look_up(names, phase);
}

std::string_view name_of(Subsystem subsystem) {
  static constexpr std::array<std::string_view, subsystem_count> names{
      "engine",     "mechanical", "electrical", "comms",         "propulsion_energy",
      "navigation", "payload",    "recovery",   "environmental", "vsm"};
  return look_up(names, subsystem);
}

std::string_view name_of(Condition condition) {
  static constexpr std::array<std::string_view, 6> names{"no_status", "nominal",   "caution",
                                                         "warning",   "emergency", "failed"};
  return look_up(names, condition);
}

}  // namespace ponte::vehicle
