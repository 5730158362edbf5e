#pragma once

#include "ponte/sim/config.hpp"
#include "ponte/sim/mission_store.hpp"
#include "ponte/sim/parameters.hpp"

namespace ponte::sim {

/// What an autopilot keeps when it starts anew.
struct OnboardMemory {
  explicit OnboardMemory(const VehicleConfig& config)
      : parameters{config.personality, config.type}, missions{config.personality, config.mission_items} {
    for (const auto& each : config.parameters) parameters.set(each.name, each.value);
  }

  Parameters parameters;
  MissionStore missions;
};

}  // namespace ponte::sim
