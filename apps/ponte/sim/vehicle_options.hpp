#pragma once

#include "ponte/sim/config.hpp"

#include <string>
#include <vector>

/// What the command line says about vehicles. Each throws `UsageError` for what it does not understand.
namespace ponte::app {

/// "LAT,LON,ALT" in degrees and metres above sea level.
[[nodiscard]] sim::Position position_from(const std::string& text);

/// "SPEED,FROM[,GUSTS]": metres per second, the degrees where it comes from, and the gusts as a share of the speed.
[[nodiscard]] sim::WindConfig wind_from(const std::string& text);

/// "NAME=VALUE" of a parameter that this autopilot has.
[[nodiscard]] sim::ParameterSetting setting_from(const std::string& text, const sim::VehicleConfig& config);

/// The faults of the vehicle with this system id among "[SYSTEM:]FAULT@TIME[+DURATION],...".
[[nodiscard]] std::vector<sim::Fault> faults_from(const std::vector<std::string>& texts, unsigned system);

/// Cuts "SYSTEM:" off the front of the text, and tells whether what follows is for this system: it is if there is none.
[[nodiscard]] bool take_target(std::string_view& text, unsigned system);

}  // namespace ponte::app
