#include "translate/translate.hpp"

#include "common/capture.hpp"
#include "common/dialect_option.hpp"
#include "common/failure.hpp"
#include "common/json_line.hpp"
#include "common/load_file.hpp"
#include "common/log.hpp"
#include "common/mavlink_options.hpp"
#include "common/outgoing.hpp"
#include "common/recorded_vsm.hpp"
#include "common/vsm_options.hpp"
#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/dli/pcap.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <map>
#include <memory>
#include <set>

namespace ponte::app {
namespace {

struct Options {
  std::string file;
  bool json{};
  std::string pcap;
  std::string dialect;
  VsmOptions vsm;
  MavlinkOptions mavlink;
  LogOptions log;
};

/// Where the DLI messages go: JSON lines, a capture, and the counts of the summary.
class Output {
 public:
  Output(const Options& options, const dli::Profile& profile) : options_{options}, profile_{profile} {
    if (!options.pcap.empty()) dli::append_pcap_header(pcap_);
  }

  void take(const vsm::OutgoingMessage& message) {
    ++counts_[view_of(message, profile_).number];
    if (options_.json) {
      append_json(json_, message, profile_);
      print_line(json_);
    }
    if (!options_.pcap.empty()) {
      constexpr dli::Ipv4Endpoint vsm{0x7F000001, 45860};
      constexpr dli::Ipv4Endpoint group{0xEFFF2D56, 45860};  // 239.255.45.86
      const auto kept = dli::append_datagram(
          pcap_, {.time = message.time, .source = vsm, .destination = group, .payload = message.bytes()});
      if (!kept)
        throw Failure{fmt::format("{}: a time before 1970 or after 2106 has no place in a pcap", options_.pcap)};
    }
  }

  void finish() const {
    if (!options_.pcap.empty()) save_file(options_.pcap, pcap_);
  }

  [[nodiscard]] const std::map<dli::MessageNumber, std::uint64_t>& counts() const { return counts_; }

 private:
  const Options& options_;
  const dli::Profile& profile_;
  std::vector<std::byte> pcap_;
  JsonText json_;
  std::map<dli::MessageNumber, std::uint64_t> counts_;
};

/// Feeds a capture to the VSM's engine, and counts what it holds.
class Translator final : public CaptureSink {
 public:
  /// With a key, frames whose signature is not right are left out.
  Translator(const vsm::TelemetryConfig& config, Output& output, const std::optional<mavlink::SigningKey>& key)
      : vsm{config}, output_{output} {
    if (key) signer_.emplace(*key, mavlink::SigningTime{});
  }

  void on_frame(std::size_t, std::optional<WallTime> time, const mavlink::FrameView& frame,
                const mavlink::MessageInfo* message) override {
    ++frames;
    if (guard.examine(time.value_or(WallTime{}), frame, signer_ ? &*signer_ : nullptr)) return;
    senders.emplace(frame.system, frame.component);
    types.insert(frame.message);
    if (message == nullptr) {
      ++unknown[frame.message];
      return;
    }
    // A dialect of the user's may give the id another meaning; then the VSM must not take it for the one it knows.
    const auto* ours = autopilot::ours(frame, *message);
    if (ours == nullptr) return;
    vsm.on_frame(time, frame, *ours, outbox_);
    drain();
  }

  void on_damage(std::size_t offset, std::optional<WallTime>, Bytes bytes, std::string_view reason) override {
    damaged_bytes += bytes.size();
    ++damages[std::string{reason}];
    if (first_damage.empty()) first_damage = fmt::format("offset {}: {}", offset, reason);
  }

  void finish() {
    vsm.finish(outbox_);
    drain();
  }

  RecordedVsm vsm;
  mavlink::LinkGuard guard{{.unsigned_frames = mavlink::UnsignedPolicy::all}};
  std::uint64_t frames{};
  std::set<std::pair<mavlink::SystemId, mavlink::ComponentId>> senders;
  std::set<mavlink::MessageId> types;
  std::map<mavlink::MessageId, std::uint64_t> unknown;
  std::map<std::string, std::uint64_t> damages;
  std::size_t damaged_bytes{};
  std::string first_damage;

 private:
  void drain() {
    outbox_.drain([&](const vsm::OutgoingMessage& message) { output_.take(message); });
  }

  static constexpr std::size_t messages_per_frame = 256;

  Output& output_;
  std::optional<mavlink::Signer> signer_;
  Outbox<vsm::OutgoingMessage> outbox_{messages_per_frame};
};

std::string summary(const Translator& translator, const Output& output) {
  std::uint64_t translated = 0;
  std::vector<std::string> numbers;
  for (const auto& [number, count] : output.counts()) {
    translated += count;
    numbers.push_back(
        fmt::format("  #{:<5} {:<40} {}\n", number.value, dli::messages::catalogue.find(number)->name, count));
  }
  std::vector<std::string> unknown;
  for (const auto& [id, count] : translator.unknown) unknown.push_back(fmt::format("unknown:{} {}", id.value, count));
  std::vector<std::string> damages;
  for (const auto& [reason, count] : translator.damages) damages.push_back(fmt::format("{} {}", reason, count));
  auto text = fmt::format("read        {} frames of {} message types from {} senders, {:.1f} s{}\n", translator.frames,
                          translator.types.size(), translator.senders.size(),
                          std::chrono::duration<double>(translator.vsm.length()).count(),
                          refusals_in(translator.guard.refused()));
  text += fmt::format("translated  {} DLI messages of {} vehicle(s)\n{}", translated, translator.vsm.vehicle_count(),
                      fmt::join(numbers, ""));
  text += fmt::format("unknown     {}\n", unknown.empty() ? "none" : fmt::format("{}", fmt::join(unknown, ", ")));
  text += translator.damages.empty()
              ? "damaged     nothing\n"
              : fmt::format("damaged     {} bytes ({})\n", translator.damaged_bytes, fmt::join(damages, ", "));
  return text;
}

void run(const Options& options) {
  const auto config = telemetry_config_from(options.vsm);
  const auto& profile = config.profile;
  const ChosenDialect dialect{options.dialect};
  const auto file = load_file(options.file);
  if (file.bytes.empty())
    throw Failure{fmt::format("{}: {}", options.file, file.damage.empty() ? "the file is empty" : file.damage)};

  Output output{options, profile};
  Translator translator{config, output, signing_key_from(options.mavlink)};
  read_capture(file.bytes, dialect.dialect(), translator);

  if (translator.frames == 0)
    throw Failure{fmt::format("{}: no MAVLink frame in {} bytes; {}", options.file, file.bytes.size(),
                              file.damage.empty() ? translator.first_damage : file.damage)};
  translator.finish();
  output.finish();
  const auto log = make_log(options.log);
  if (!translator.first_damage.empty())
    log->warn("{}: damaged at {}, {} bytes in all were left out", options.file, translator.first_damage,
              translator.damaged_bytes);
  if (!file.damage.empty()) log->warn("{}: damaged at {}", options.file, file.damage);
  if (!options.log.quiet) fmt::print(options.json ? stderr : stdout, "{}", summary(translator, output));
}

}  // namespace

void add_translate(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("translate", "Turn a recording of MAVLink into STANAG 4586 messages");
  command->add_option("FILE", options->file, "A .tlog, a text of \"microseconds hex\" lines or raw bytes; also gzipped")
      ->required();
  command->add_flag("--json", options->json, "Print one JSON object per DLI message on stdout");
  command->add_option("--pcap", options->pcap, "Write the DLI datagrams to a capture for Wireshark");
  add_signing_key_option(*command, options->mavlink);
  add_dialect_option(*command, options->dialect);
  add_vsm_options(*command, options->vsm);
  add_log_options(*command, options->log);
  command->footer("Example:\n  ponte translate tests/recordings/ap_mission_v2_trimmed.tlog.gz --json");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
