#include "inspect/inspect.hpp"

#include "common/failure.hpp"
#include "common/json_line.hpp"
#include "common/load_file.hpp"
#include "inspect/hex_view.hpp"
#include "inspect/traffic.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/json.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

namespace ponte::app {
namespace {

struct Options {
  std::string file;
  bool json{};
  bool hex{};
};

void print_json(const Traffic& traffic, const std::string& link) {
  JsonText json;
  for (const auto& [key, tally] : traffic.messages) {
    json.begin_object().member("kind", "message").member("link", std::string_view{link});
    json.member("system", unsigned{key.system.value}).member("component", unsigned{key.component.value});
    json.member("id", unsigned{key.message.value}).member("name", std::string_view{tally.name(key.message)});
    json.member("count", tally.count);
    if (const auto rate = tally.rate()) json.member("rate_hz", *rate);
    if (tally.message != nullptr) {
      json.key("last");
      mavlink::append_fields(json, *tally.message, tally.last_payload);
    }
    json.end_object();
    print_line(json);
  }
  for (const auto& sender : traffic.losses.senders()) {
    json.begin_object().member("kind", "sender").member("link", std::string_view{link});
    json.member("system", unsigned{sender.system.value}).member("component", unsigned{sender.component.value});
    json.member("received", sender.received).member("lost", sender.lost()).member("late", sender.late);
    json.member("duplicates", sender.duplicates).end_object();
    print_line(json);
  }
  for (const auto& [reason, damage] : traffic.damages) {
    json.begin_object().member("kind", "skipped").member("link", std::string_view{link});
    json.member("reason", std::string_view{reason}).member("count", damage.count).member("bytes", damage.bytes);
    json.end_object();
    print_line(json);
  }
}

void print_table(const Traffic& traffic, CaptureFormat format) {
  fmt::print("{:>3} {:>4} {:>6} {:<42} {:>9} {:>9}\n", "sys", "comp", "id", "message", "count", "Hz");
  for (const auto& [key, tally] : traffic.messages) {
    const auto rate = tally.rate();
    fmt::print("{:>3} {:>4} {:>6} {:<42} {:>9} {:>9}\n", key.system.value, key.component.value, key.message.value,
               tally.name(key.message), tally.count, rate ? fmt::format("{:.2f}", *rate) : "-");
  }
  fmt::print("\n{:>3} {:>4} {:>9} {:>9} {:>9} {:>9} {:>7}\n", "sys", "comp", "received", "lost", "lost %", "late",
             "twice");
  for (const auto& sender : traffic.losses.senders()) {
    const auto sent = sender.received + sender.lost();
    fmt::print("{:>3} {:>4} {:>9} {:>9} {:>9.3f} {:>9} {:>7}\n", sender.system.value, sender.component.value,
               sender.received, sender.lost(),
               sent == 0 ? 0.0 : 100.0 * static_cast<double>(sender.lost()) / static_cast<double>(sent), sender.late,
               sender.duplicates);
  }
  fmt::print("\n{} frames in a {}", traffic.frames, name_of(format));
  for (const auto& [byte, count] : traffic.start_bytes) fmt::print(", start byte 0x{:02X}: {}", byte, count);
  if (traffic.signed_frames > 0) fmt::print(", signed: {}", traffic.signed_frames);
  fmt::print("\n");
  for (const auto& [reason, damage] : traffic.damages)
    fmt::print("skipped {} bytes: {} ({} times)\n", damage.bytes, reason, damage.count);
}

void run(const Options& options) {
  const auto file = load_file(options.file);
  if (file.bytes.empty())
    throw Failure{fmt::format("{}: {}", options.file, file.damage.empty() ? "the file is empty" : file.damage)};
  Traffic traffic;
  HexView hex{traffic, options.json};
  const auto format =
      read_capture(file.bytes, mavlink::autopilots::dialect, options.hex ? static_cast<CaptureSink&>(hex) : traffic);
  hex.finish();
  if (traffic.frames == 0)
    throw Failure{fmt::format("{}: no MAVLink frame in {} bytes; {}", options.file, file.bytes.size(),
                              file.damage.empty() ? traffic.first_damage : file.damage)};
  if (options.json)
    print_json(traffic, options.file);
  else
    print_table(traffic, format);
  if (!traffic.first_damage.empty()) fmt::print(stderr, "{}: damaged at {}\n", options.file, traffic.first_damage);
  if (!file.damage.empty()) fmt::print(stderr, "{}: damaged at {}\n", options.file, file.damage);
}

}  // namespace

void add_inspect(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("inspect", "List the message types, rates and losses of a recording");
  command->add_option("FILE", options->file, "A .tlog, a text of \"microseconds hex\" lines or raw bytes; also gzipped")
      ->required();
  command->add_flag("--json", options->json, "One JSON object per line");
  command->add_flag("--hex", options->hex, "Show every byte first: frames, text between them, noise");
  command->footer("Example:\n  ponte inspect tests/recordings/ap_boot_raw_datagrams.txt.gz --hex");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
