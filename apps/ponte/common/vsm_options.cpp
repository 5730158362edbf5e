#include "common/vsm_options.hpp"

#include "common/failure.hpp"
#include "common/load_file.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/dli/profile_file.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

namespace ponte::app {
namespace {

template <std::size_t Size>
Text<Size> text_from(const char* option, const std::string& text) {
  if (text.size() > Size) throw UsageError{fmt::format("{}: at most {} characters", option, Size)};
  return Text<Size>{text};
}

}  // namespace

dli::Profile profile_from(const ProfileOptions& options) {
  if (options.profile.empty()) return dli::Profile{options.edition == "3" ? dli::Edition::ed3 : dli::Edition::ed_a};
  const auto loaded = load_file(options.profile);
  const std::string_view text{reinterpret_cast<const char*>(loaded.bytes.data()), loaded.bytes.size()};
  auto profile = dli::parse_profile(text, dli::messages::catalogue);
  if (!profile)
    throw Failure{fmt::format("{}:{}: {}{}expected {}", options.profile, profile.error().line, profile.error().key,
                              profile.error().key.empty() ? "" : ": ", profile.error().expectation)};
  return *profile;
}

void add_profile_options(CLI::App& command, ProfileOptions& options) {
  auto* edition = command.add_option("--edition", options.edition, "Edition of the standard")
                      ->check(CLI::IsMember({"3", "A"}))
                      ->capture_default_str();
  command.add_option("--profile", options.profile, "TOML file: edition, checksum, scales that differ")
      ->excludes(edition);
}

void add_vsm_options(CLI::App& command, VsmOptions& options) {
  add_profile_options(command, options.dli);
  command.add_option("--owning-id", options.owning_id, "Owning code of the ids, e.g. 20 Portugal; 255 is reserved")
      ->check(CLI::Range(0U, 254U))
      ->capture_default_str();
  command.add_option("--vsm-id", options.vsm_id, "National part of the VSM's id")
      ->check(CLI::Range(0U, dli::EntityId::national_mask))
      ->capture_default_str();
  command.add_option("--vehicle-type", options.vehicle_type, "Vehicle Type of the standard's table; 0: not identified")
      ->check(CLI::Range(0U, 0xFFFFU))
      ->capture_default_str();
  command.add_option("--tail-number", options.tail_number, "Instead of the autopilot's serial number");
  command.add_option("--call-sign", options.call_sign, "ATC Call Sign");
}

vsm::TelemetryConfig telemetry_config_from(const VsmOptions& options) {
  vsm::TelemetryConfig config;
  config.profile = profile_from(options.dli);
  config.vsm = dli::EntityId{static_cast<std::uint8_t>(options.owning_id), dli::EntityType::vsm, options.vsm_id};
  config.description.vehicle_type = static_cast<std::uint16_t>(options.vehicle_type);
  config.description.tail_number = text_from<15>("--tail-number", options.tail_number);
  config.description.call_sign = text_from<31>("--call-sign", options.call_sign);
  return config;
}

}  // namespace ponte::app
