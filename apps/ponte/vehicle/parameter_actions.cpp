#include "common/load_file.hpp"
#include "ponte/autopilot/parameter_file.hpp"
#include "ponte/autopilot/parameter_pack.hpp"
#include "ponte/core/bytes.hpp"
#include "vehicle/actions.hpp"
#include "vehicle/carry_out.hpp"

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include <memory>

/// Parameters, one or all, and their files.
namespace ponte::app {
namespace {

using autopilot::Parameter;
using autopilot::ParameterFact;
using autopilot::Voice;

template <class Begin>
ParameterFact ask(Operator& station, std::string_view action, Begin&& begin) {
  const auto request = station.begin(action, begin, never_early);
  const auto fact = station.await<ParameterFact>(
      [&](const ParameterFact& each) { return each.request == *request && each.kind != ParameterFact::Kind::progress; },
      [&](const ParameterFact& each) {
        if (!station.wants_json() && each.kind == ParameterFact::Kind::progress && each.done % 100 == 0)
          fmt::print(stderr, "\r{} of {} ", each.done, each.total);
      });
  if (fact.kind != ParameterFact::Kind::failed) return fact;
  const bool is_refused = fact.failure == autopilot::ParameterFailure::refused;
  auto words = std::string{to_text(fact.failure)};
  if (fact.failure == autopilot::ParameterFailure::differs) words += fmt::format(": {}", fact.parameter.value);
  station.give_up(action, is_refused ? parameter_error_name(fact.error) : std::string{}, words);
}

void print_parameter(Operator& station, const Parameter& parameter) {
  if (!station.wants_json()) return fmt::print("{:<16} {}\n", parameter.name.view(), parameter.value);
  station.json()
      .member("name", parameter.name.view())
      .member("value", parameter.value)
      .member("type", static_cast<unsigned>(parameter.type));
  station.print();
}

/// True: the vehicle has given its file of parameters.
bool read_file(Operator& station) {
  if (!offers_files(station)) return false;
  auto& files = station.client().files();
  const auto fact =
      use_file(station, "params", [&](Voice voice) { return files.read(station.now(), "@PARAM/param.pck", voice); });
  if (fact.kind != autopilot::FileFact::Kind::was_read) return false;
  auto all = autopilot::unpack_parameters(files.content());
  if (!all) return false;
  station.client().parameters().take_over(std::move(*all));
  return true;
}

/// In ArduPilot's packed file where there is one, else one by one.
std::vector<Parameter> fetch_all(Operator& station) {
  auto& parameters = station.client().parameters();
  if (read_file(station)) return parameters.known();
  const auto fact = ask(station, "params", [&](Voice voice) { return parameters.fetch_all(station.now(), voice); });
  if (!station.wants_json()) fmt::print(stderr, "\r{} parameters\n", fact.total);
  return parameters.known();
}

void set(Operator& station, std::string_view name, double value) {
  const auto fact = ask(station, fmt::format("params set {}", name), [&](Voice voice) {
    return station.client().parameters().set(station.now(), name, value, voice);
  });
  print_parameter(station, fact.parameter);
}

/// The name of the file tells the format: MAVProxy's `.parm`, else QGroundControl's.
void save(Operator& station, const std::string& file) {
  const auto all = fetch_all(station);
  const auto& peer = station.client().peer();
  const auto text = file.ends_with(".parm")
                        ? autopilot::write_mavproxy_file(all)
                        : autopilot::write_qgroundcontrol_file(all, peer.system.value, peer.component.value);
  save_file(file, bytes_of(text));
  station.tell_done("params save");
}

/// Those that differ from what the vehicle has. One that it does not take does not keep the others back.
void load(Operator& station, const std::string& file) {
  const auto loaded = load_file(file);
  if (!loaded.damage.empty()) throw Failure{fmt::format("{}: {}", file, loaded.damage)};
  const auto lines = autopilot::read_parameter_file(loaded.bytes);
  if (!lines)
    throw Failure{fmt::format("{}: line {}: {}: expected {}", file, lines.error().line, lines.error().what,
                              lines.error().expectation)};
  (void)fetch_all(station);
  std::vector<std::string> failures;
  for (const auto& line : *lines) {
    const auto* known = station.client().parameters().find(line.name.view());
    if (known != nullptr && known->value == line.value) continue;
    try {
      set(station, line.name.view(), line.value);
    } catch (const Failure& failure) {
      failures.push_back(fmt::format("line {}: {}", line.line, failure.what()));
    }
  }
  if (failures.empty()) return station.tell_done("params load");
  throw Failure{
      fmt::format("{}: {} of {} were not set: {}", file, failures.size(), lines->size(), fmt::join(failures, "; "))};
}

void add_file_action(CLI::App& params, Action& chosen, const char* name, const char* description,
                     void (*act)(Operator&, const std::string&)) {
  auto file = std::make_shared<std::string>();
  auto* action = params.add_subcommand(name, description);
  action->add_option("FILE", *file, "MAVProxy's .parm, or QGroundControl's .params")->required();
  action->callback([&chosen, file, act] { chosen = [file, act](Operator& station) { act(station, *file); }; });
}

}  // namespace

void add_parameter_actions(CLI::App& command, Action& chosen) {
  auto* params = command.add_subcommand("params", "Parameters");
  params->require_subcommand(1);
  add_simple_action(*params, chosen, "list", "All of them", [](Operator& station) {
    for (const auto& each : fetch_all(station)) print_parameter(station, each);
  });

  auto wanted = std::make_shared<std::string>();
  auto* get_action = params->add_subcommand("get", "One");
  get_action->add_option("NAME", *wanted)->required();
  get_action->callback([&chosen, wanted] {
    chosen = [wanted](Operator& station) {
      const auto fact = ask(station, "params get " + *wanted, [&](Voice voice) {
        return station.client().parameters().get(station.now(), *wanted, voice);
      });
      print_parameter(station, fact.parameter);
    };
  });

  auto target = std::make_shared<std::pair<std::string, double>>();
  auto* set_action = params->add_subcommand("set", "One, which is done when the vehicle says that it has the value");
  set_action->add_option("NAME", target->first)->required();
  set_action->add_option("VALUE", target->second)->required();
  set_action->callback(
      [&chosen, target] { chosen = [target](Operator& station) { set(station, target->first, target->second); }; });

  add_file_action(*params, chosen, "save", "All of them, into a file", save);
  add_file_action(*params, chosen, "load", "Those of a file that differ", load);
}

}  // namespace ponte::app
