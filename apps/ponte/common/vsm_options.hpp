#pragma once

#include "ponte/vsm/telemetry.hpp"

#include <CLI/App.hpp>

#include <string>

namespace ponte::app {

/// What a command line says of the VSM that it makes: edition or profile, and ids.
struct VsmOptions {
  std::string edition{"3"};
  std::string profile;
  unsigned owning_id{20};
  unsigned vsm_id{1};
  unsigned vehicle_type{};
  std::string tail_number;
  std::string call_sign;
};

void add_vsm_options(CLI::App& command, VsmOptions& options);

/// Throws `Failure` or `UsageError`.
[[nodiscard]] vsm::TelemetryConfig telemetry_config_from(const VsmOptions& options);

}  // namespace ponte::app
