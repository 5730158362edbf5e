#include "inspect/inspect.hpp"

#include "common/dialect_option.hpp"
#include "common/endpoint_option.hpp"
#include "common/failure.hpp"
#include "common/load_file.hpp"
#include "common/log.hpp"
#include "common/mavlink_options.hpp"
#include "common/terminal.hpp"
#include "common/vsm_options.hpp"
#include "inspect/hex_view.hpp"
#include "inspect/live_traffic.hpp"
#include "inspect/message_printer.hpp"
#include "inspect/recent_rates.hpp"
#include "inspect/report.hpp"
#include "inspect/traffic.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/dli/json.hpp"
#include "ponte/dli/messages/catalogue.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

namespace ponte::app {
namespace {

using namespace std::chrono_literals;

struct Options {
  std::string place;
  bool json{};
  bool hex{};
  bool messages{};
  std::optional<double> seconds;
  MavlinkOptions mavlink;
  std::string dialect;
  ProfileOptions profile;
  LogOptions log;
};

/// What is done with every frame before it is counted.
class Views {
 public:
  Views(const Options& options, CaptureSink& next) : hex_{next, options.json}, messages_{next} {
    if (options.hex)
      sink_ = &hex_;
    else if (options.messages)
      sink_ = &messages_;
    else
      sink_ = &next;
  }
  [[nodiscard]] CaptureSink& sink() { return *sink_; }
  void finish() { hex_.finish(); }

 private:
  HexView hex_;
  MessagePrinter messages_;
  CaptureSink* sink_;
};

std::optional<double> average_rate(const Tally& tally) { return tally.rate(); }

void inspect_file(const Options& options, const mavlink::Dialect& dialect) {
  const auto file = load_file(options.place);
  if (file.bytes.empty())
    throw Failure{fmt::format("{}: {}", options.place, file.damage.empty() ? "the file is empty" : file.damage)};
  Traffic traffic{signing_key_from(options.mavlink)};
  Views views{options, traffic};
  const auto format = read_capture(file.bytes, dialect, views.sink());
  views.finish();
  if (traffic.frames == 0)
    throw Failure{fmt::format("{}: no MAVLink frame in {} bytes; {}", options.place, file.bytes.size(),
                              file.damage.empty() ? traffic.first_damage : file.damage)};
  if (options.json && !options.messages)
    print_json(traffic, options.place);
  else if (!options.messages)
    fmt::print("{}{}: {}\n", mavlink_table(traffic, average_rate, false), name_of(format), options.place);
  const auto log = make_log(options.log);
  if (!traffic.first_damage.empty()) log->warn("{}: damaged at {}", options.place, traffic.first_damage);
  if (!file.damage.empty()) log->warn("{}: damaged at {}", options.place, file.damage);
}

/// A table on the terminal, drawn anew every second. 'q' ends it.
class Window {
 public:
  Window(transport::Loop& loop, const Traffic& mavlink, const DliTraffic& dli)
      : loop_{loop}, mavlink_{mavlink}, dli_{dli}, timer_{loop, [this](Timestamp now) {
                                                            turn(now);
                                                            timer_.set(now + turn_period);
                                                          }} {
    timer_.set(loop.now());
  }

 private:
  static constexpr auto turn_period = 100ms;
  static constexpr auto draw_period = 1s;

  void turn(Timestamp now) {
    while (const auto key = terminal_.key())
      if (*key == 'q') loop_.stop();
    if (now < next_draw_) return;
    next_draw_ = now + draw_period;
    draw();
    rates_.next_second();
    for (const auto& [key, tally] : mavlink_.messages) rates_.note(tally);
    for (const auto& [key, tally] : dli_.messages) rates_.note(tally);
  }

  void draw() {
    const auto rate_of = [&](const Tally& tally) { return rates_.of(tally); };
    std::string text = "ponte inspect, rates of the last seconds; key: q quit\n\n";
    if (mavlink_.frames > 0 || !mavlink_.damages.empty()) text += mavlink_table(mavlink_, rate_of, true) + "\n";
    if (dli_.counters.datagrams > 0) text += dli_table(dli_, rate_of, true);
    terminal_.draw(text);
  }

  transport::Loop& loop_;
  const Traffic& mavlink_;
  const DliTraffic& dli_;
  RecentRates rates_;
  Terminal terminal_;
  Timestamp next_draw_{};
  transport::Timer timer_;
};

void inspect_live(const Options& options, const mavlink::Dialect& dialect) {
  const auto profile = profile_from(options.profile);
  Traffic traffic{signing_key_from(options.mavlink)};
  DliTraffic dli{profile};
  Views views{options, traffic};
  JsonText json;
  const auto on_dli = [&](WallTime time, const dli::WrapperView& message) {
    if (!options.messages) return;
    if (!dli::append_json(json, message, dli::messages::catalogue, profile, unix_ms(time))) return;
    print_line(json);
  };
  transport::Loop loop;
  const bool prints = options.json || options.hex || options.messages;
  const bool has_window = !prints && Terminal::is_there();
  auto log_options = options.log;
  if (has_window) log_options.quiet = true;  // lines of a log would tear the window
  LiveTraffic live{loop,  endpoint_from("ENDPOINT", options.place), make_log(log_options), dialect, views.sink(), dli,
                   on_dli};
  loop.on_signal([&](int) { loop.stop(); });
  {
    std::optional<Window> window;
    if (has_window) window.emplace(loop, traffic, dli);
    if (options.seconds)
      loop.run_for(std::chrono::duration_cast<Duration>(std::chrono::duration<double>{*options.seconds}));
    else
      loop.run();
  }
  views.finish();
  if (options.messages) return;
  if (options.json) {
    print_json(traffic, options.place);
    print_json(dli, options.place);
    return;
  }
  if (traffic.frames == 0 && dli.counters.messages == 0) fmt::print("nothing was heard on {}\n", options.place);
  if (traffic.frames > 0 || !traffic.damages.empty()) fmt::print("{}", mavlink_table(traffic, average_rate, false));
  if (dli.counters.datagrams > 0) fmt::print("{}", dli_table(dli, average_rate, false));
}

void run(const Options& options) {
  constexpr std::string_view file_scheme = "file://";
  const ChosenDialect dialect{options.dialect};
  auto chosen = options;
  if (chosen.place.starts_with(file_scheme)) chosen.place.erase(0, file_scheme.size());
  if (chosen.place.find("://") == std::string::npos)
    inspect_file(chosen, dialect.dialect());
  else
    inspect_live(chosen, dialect.dialect());
}

}  // namespace

void add_inspect(CLI::App& app) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand("inspect", "List message types, rates, losses and last values, live or of a file");
  command
      ->add_option(
          "ENDPOINT_OR_FILE", options->place,
          "Where to listen, e.g. udpin://0.0.0.0:14550; or a .tlog, a text of \"microseconds hex\" lines or raw "
          "bytes; also gzipped")
      ->required();
  command->add_flag("--json", options->json, "One JSON object per line of the table");
  auto* hex = command->add_flag("--hex", options->hex, "Show every byte first: frames, text between them, noise");
  command->add_flag("--messages", options->messages, "One JSON object per message as it comes, and no table")
      ->excludes(hex);
  command->add_option("--seconds", options->seconds, "Stop listening after so long")->check(CLI::Range(0.1, 1e6));
  add_signing_key_option(*command, options->mavlink);
  add_dialect_option(*command, options->dialect);
  add_profile_options(*command, options->profile);
  add_log_options(*command, options->log);
  command->footer(
      "Examples:\n  ponte inspect udpin://0.0.0.0:14550\n"
      "  ponte inspect tests/recordings/ap_boot_raw_datagrams.txt.gz --hex");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
