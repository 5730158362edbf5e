#pragma once

#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/link_guard.hpp"
#include "ponte/mavlink/signing_key.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>

namespace ponte::app {

/// What a command line says of the MAVLink that is spoken: its version, and signatures.
struct MavlinkOptions {
  std::string version{"2"};
  std::string key_file;
  std::string time_file;
  std::string unsigned_frames;
};

/// Adds `--signing-key FILE` alone, for who only verifies.
void add_signing_key_option(CLI::App& command, MavlinkOptions& options);
/// Adds all of them; `version_means` says whose version it is.
void add_mavlink_options(CLI::App& command, MavlinkOptions& options, const std::string& version_means);

[[nodiscard]] mavlink::Version version_from(const MavlinkOptions& options);

/// The key in the file, which nobody but its owner may use, or in the variable PONTE_SIGNING_KEY; nothing without
/// either. Throws `Failure`, which never repeats what was read.
[[nodiscard]] std::optional<mavlink::SigningKey> signing_key_from(const MavlinkOptions& options);

/// What is demanded of every link. Throws `UsageError` when the options contradict one another.
[[nodiscard]] mavlink::LinkPolicy link_policy_from(const MavlinkOptions& options);

/// "; refused: 3 unsigned, 1 replayed", or nothing.
[[nodiscard]] std::string refusals_in(const mavlink::Refusals& refused);

}  // namespace ponte::app
