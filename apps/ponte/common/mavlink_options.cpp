#include "common/mavlink_options.hpp"

#include "common/failure.hpp"
#include "common/signing_key_file.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <vector>

namespace ponte::app {
namespace {

constexpr auto key_variable = "PONTE_SIGNING_KEY";
constexpr auto signed_only = "2-signed-only";

std::vector<mavlink::MessageId> messages_from(const std::string& names) {
  std::vector<mavlink::MessageId> messages;
  std::istringstream words{names};
  for (std::string name; std::getline(words, name, ',');) {
    const auto& known = mavlink::autopilots::dialect.messages;
    const auto found = std::ranges::find(known, name, &mavlink::MessageInfo::name);
    if (found == known.end())
      throw UsageError{fmt::format(
          "--unsigned {}: expected all, none, until-signed, or names of messages such as RADIO_STATUS,RADIO", name)};
    messages.push_back((*found)->id);
  }
  return messages;
}

}  // namespace

void add_signing_key_option(CLI::App& command, MavlinkOptions& options) {
  command.add_option(
      "--signing-key", options.key_file,
      fmt::format("File of its owner alone with the key of MAVLink 2 signatures: 32 bytes, 64 hex digits "
                  "or passphrase=WORDS. Or set {}",
                  key_variable));
}

void add_mavlink_options(CLI::App& command, MavlinkOptions& options, const std::string& version_means) {
  command
      .add_option("--mavlink", options.version,
                  fmt::format("{}; 2-signed-only refuses what is not signed", version_means))
      ->check(CLI::IsMember({"0.9", "1", "2", signed_only}))
      ->capture_default_str();
  add_signing_key_option(command, options);
  command.add_option("--signing-time", options.time_file,
                     "Where the time stamp of signatures is kept between two runs (KEYFILE.time)");
  command.add_option(
      "--unsigned", options.unsigned_frames,
      "Unsigned frames that are accepted all the same: all, none, until-signed (RADIO_STATUS from then on), "
      "or names of messages (until-signed; RADIO_STATUS with 2-signed-only)");
}

mavlink::Version version_from(const MavlinkOptions& options) {
  for (const auto version : {mavlink::Version::v0_9, mavlink::Version::v1})
    if (options.version == mavlink::to_text(version)) return version;
  return mavlink::Version::v2;
}

std::optional<mavlink::SigningKey> signing_key_from(const MavlinkOptions& options) {
  if (!options.key_file.empty()) return read_signing_key_file(options.key_file);
  const char* const content = std::getenv(key_variable);
  if (content == nullptr) return {};
  auto key = mavlink::read_signing_key(bytes_of(std::string_view{content}));
  if (!key) throw Failure{fmt::format("{}: expected 64 hex digits or passphrase=WORDS", key_variable)};
  return key;
}

mavlink::LinkPolicy link_policy_from(const MavlinkOptions& options) {
  using mavlink::UnsignedPolicy;
  const bool is_signed_only = options.version == signed_only;
  const bool has_key = !options.key_file.empty() || std::getenv(key_variable) != nullptr;
  if (!has_key && is_signed_only)
    throw UsageError{fmt::format("--mavlink {}: expected --signing-key FILE too", signed_only)};
  if (!has_key && !options.unsigned_frames.empty())
    throw UsageError{"--unsigned: expected --signing-key FILE too, as without a key every frame is accepted"};
  if (has_key && version_from(options) != mavlink::Version::v2)
    throw UsageError{fmt::format("--mavlink {}: cannot be signed; expected 2 or 2-signed-only", options.version)};

  const auto& wish = options.unsigned_frames;
  if (is_signed_only && (wish == "all" || wish == "until-signed"))
    throw UsageError{fmt::format("--unsigned {}: contradicts --mavlink {}", wish, signed_only)};
  mavlink::LinkPolicy policy;
  if (is_signed_only) policy.unsigned_frames = UnsignedPolicy::listed;
  if (wish.empty() || wish == "until-signed") return policy;
  policy.unsigned_frames = wish == "all" ? UnsignedPolicy::all : UnsignedPolicy::listed;
  if (wish != "all") policy.unsigned_list = wish == "none" ? std::vector<mavlink::MessageId>{} : messages_from(wish);
  return policy;
}

std::string refusals_in(const mavlink::Refusals& refused) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < refused.size(); ++i)
    if (refused[i] > 0) parts.push_back(fmt::format("{} {}", refused[i], name_of(static_cast<mavlink::Refusal>(i))));
  return parts.empty() ? std::string{} : fmt::format("; refused: {}", fmt::join(parts, ", "));
}

}  // namespace ponte::app
