#pragma once

#include "ponte/vsm/telemetry.hpp"

#include <CLI/App.hpp>

#include <string>

namespace ponte::app {

/// What a command line says of the DLI that is spoken: an edition or a profile.
struct ProfileOptions {
  std::string edition{"3"};
  std::string profile;
};

void add_profile_options(CLI::App& command, ProfileOptions& options);

/// Throws `Failure`.
[[nodiscard]] dli::Profile profile_from(const ProfileOptions& options);

/// What a command line says of the VSM that it makes.
struct VsmOptions {
  ProfileOptions dli;
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
