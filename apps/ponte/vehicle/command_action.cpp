#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/field_value.hpp"
#include "vehicle/actions.hpp"
#include "vehicle/carry_out.hpp"

#include <CLI/CLI.hpp>

#include <charconv>
#include <memory>
#include <vector>

/// Any command of MAVLink, by its name or number.
namespace ponte::app {
namespace {

using autopilot::Command;
using autopilot::CommandFact;

struct Options {
  std::string name;
  std::vector<double> parameters;
  std::optional<std::uint8_t> frame;
};

std::uint16_t number_of(const std::string& name) {
  std::uint16_t number{};
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error == std::errc{} && end == name.data() + name.size()) return number;
  const auto& commands = mavlink::autopilots::enum_info::MAV_CMD;
  auto found = mavlink::value_of(commands, name);
  if (!found) found = mavlink::value_of(commands, "MAV_CMD_" + name);
  if (!found)
    throw UsageError{fmt::format("{}: expected a name of MAV_CMD, with or without its beginning, or a number", name)};
  return static_cast<std::uint16_t>(*found);
}

Command command_from(const Options& options) {
  auto p = options.parameters;
  p.resize(7);
  return {.number = number_of(options.name),
          .param1 = static_cast<float>(p[0]),
          .param2 = static_cast<float>(p[1]),
          .param3 = static_cast<float>(p[2]),
          .param4 = static_cast<float>(p[3]),
          .x = p[4],
          .y = p[5],
          .z = static_cast<float>(p[6]),
          .frame = options.frame};
}

void tell_progress(const Operator& station, const CommandFact& fact) {
  if (!station.wants_json() && fact.kind == CommandFact::Kind::progress && fact.progress <= 100)
    fmt::print("{} %\n", fact.progress);
}

}  // namespace

void add_command_action(CLI::App& command, Action& chosen) {
  auto options = std::make_shared<Options>();
  auto* action = command.add_subcommand("command", "Any command of MAVLink");
  action->add_option("NAME", options->name, "Of MAV_CMD, e.g. DO_SET_HOME, or its number")->required();
  action->add_option("PARAMETERS", options->parameters, "Up to seven; 0 where there are fewer, nan: left open")
      ->expected(0, 7);
  action->add_option("--frame", options->frame,
                     "MAV_FRAME of the place that parameters 5 to 7 are, in degrees and metres (0 above the sea, 3 "
                     "above home)");
  action->callback([&chosen, options] {
    chosen = [wanted = command_from(*options), name = options->name](Operator& station) {
      const auto request = station.begin(
          name,
          [&](autopilot::Voice voice) { return station.client().commands().request(station.now(), wanted, voice); },
          never_early);
      const auto fact = station.await<CommandFact>(
          [&](const CommandFact& each) { return each.request == *request && each.is_final(); },
          [&](const CommandFact& each) { tell_progress(station, each); });
      if (fact.kind == CommandFact::Kind::accepted) return station.tell_done(name);
      station.give_up(name, code_of(fact), with_reason(to_text(fact.kind), fact.reason.view()));
    };
  });
}

}  // namespace ponte::app
