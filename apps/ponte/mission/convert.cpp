#include "mission/convert.hpp"

#include "common/failure.hpp"
#include "common/load_file.hpp"
#include "mission/mission_input.hpp"
#include "mission/mission_json.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

namespace ponte::app {
namespace {

struct Options {
  MissionInput input;
  std::string output;
  std::string output_format;
  bool json{};
  bool quiet{};
};

planning::Format output_format(const Options& options) {
  if (!options.output_format.empty()) return planning::format_named(options.output_format).value();
  const auto format = planning::format_of_name(options.output);
  if (!format) throw UsageError{fmt::format("{}: the name tells no format: expected --to", options.output)};
  return *format;
}

std::string counted(const planning::MissionFile& content) {
  return fmt::format("{} points, {} items", content.points.size(), content.mission.items.size());
}

void run(const Options& options) {
  if (options.output.empty() && !options.json) throw UsageError{"mission convert: expected OUT, or --json"};
  const bool writes = !options.output.empty();
  const auto target = writes ? output_format(options) : planning::Format{};  // wrong options are told before any work
  const auto loaded = load_mission(options.input);
  if (options.json) print_json(loaded.content);
  auto* const summary = options.json ? stderr : stdout;
  if (!options.quiet)
    fmt::print(summary, "read   {}: {} ({})\n", options.input.file, counted(loaded.content), name_of(loaded.format));
  if (!writes) return;
  const auto writing = planning::write_mission_file(target, loaded.content);
  if (!writing) throw Failure{to_text(options.input.file, writing.error())};
  save_file(options.output, writing->bytes);
  for (const auto& loss : writing->losses) fmt::print(stderr, "{}: lost: {}\n", options.output, loss);
  if (!options.quiet)
    fmt::print(summary, "wrote  {}: {} bytes ({})\n", options.output, writing->bytes.size(), name_of(target));
}

}  // namespace

void add_mission_convert(CLI::App& mission) {
  auto options = std::make_shared<Options>();
  auto* command = mission.add_subcommand("convert", "Turn a file of points or of a mission into another format");
  command
      ->add_option("IN", options->input.file,
                   "path.poi, CSV, GeoJSON, KML, KMZ, GPX, QGroundControl's .plan, QGC WPL (.waypoints); also gzipped")
      ->required();
  command->add_option("OUT", options->output, "The file to write; its name tells the format");
  add_mission_input_options(*command, options->input);
  command->add_option("--to", options->output_format, "Format of OUT, if its name does not tell")
      ->check(CLI::IsMember(planning::format_names()));
  command->add_flag("--json", options->json, "Print what IN holds, one JSON object per line on stdout");
  command->add_flag("--quiet", options->quiet, "No summary");
  command->footer("Example:\n  ponte mission convert tests/vectors/missions/survey.plan survey.waypoints");
  command->callback([options] { run(*options); });
}

}  // namespace ponte::app
