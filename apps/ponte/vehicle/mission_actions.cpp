#include "common/load_file.hpp"
#include "mission/mission_input.hpp"
#include "mission/mission_json.hpp"
#include "ponte/autopilot/plan_file.hpp"
#include "vehicle/actions.hpp"
#include "vehicle/carry_out.hpp"

#include <CLI/CLI.hpp>

#include <memory>

/// Missions, fences and rally points, between files and the vehicle.
namespace ponte::app {
namespace {

using autopilot::MissionFact;
using autopilot::PlanType;
using autopilot::Voice;
using autopilot::WireItem;

struct Plan {
  PlanType type;
  std::string_view name;
};
constexpr std::array plans{Plan{PlanType::mission, "mission"}, Plan{PlanType::fence, "fence"},
                           Plan{PlanType::rally, "rally points"}};

void tell_progress(const Operator& station, const MissionFact& fact) {
  if (fact.kind == MissionFact::Kind::progress && !station.wants_json() && fact.total > 0)
    fmt::print(stderr, "\r{} of {}{}", fact.done, fact.total, fact.done == fact.total ? "\n" : "");
}

std::string words_for(const MissionFact& fact) {
  auto words = std::string{to_text(fact.failure)};
  if (fact.failure == autopilot::MissionFailure::refused || fact.failure == autopilot::MissionFailure::differs)
    words += fmt::format(" (item {})", fact.item);
  const auto left = to_text(fact.plan);
  return left.empty() ? words : fmt::format("{}; on board is {}", words, left);
}

template <class Begin>
MissionFact transfer(Operator& station, std::string_view action, Begin&& begin) {
  const auto request = station.begin(action, begin, never_early);
  const auto fact = station.await<MissionFact>(
      [&](const MissionFact& each) { return each.request == *request && each.kind != MissionFact::Kind::progress; },
      [&](const MissionFact& each) { tell_progress(station, each); });
  if (fact.kind != MissionFact::Kind::failed) return fact;
  const bool is_refused = fact.failure == autopilot::MissionFailure::refused;
  station.give_up(action, is_refused ? mission_result_name(fact.result) : std::string{}, words_for(fact));
}

std::vector<WireItem> items_for(Operator& station, const std::string& file, const Plan& plan,
                                const vehicle::Mission& mission) {
  auto items = autopilot::to_wire(station.client().peer().stack, plan.type, mission);
  if (!items)
    throw Failure{fmt::format("{}: {}: item {}: {}", file, plan.name, items.error().item, items.error().what)};
  return std::move(*items);
}

/// Items are sent as a file where the vehicle has files. True: it has taken it.
bool sends_file(Operator& station, std::string_view action, const Plan& plan, const std::vector<WireItem>& items) {
  if (items.empty() || !offers_files(station)) return false;
  const auto fact = use_file(station, action, [&](Voice voice) {
    return station.client().files().write(station.now(), autopilot::plan_path(plan.type),
                                          autopilot::pack_plan(plan.type, items), voice);
  });
  return fact.kind == autopilot::FileFact::Kind::written;
}

/// Each plan that the file has; a mission also if it has none, so that the old one does not stay.
void upload(Operator& station, const MissionInput& input) {
  const auto loaded = load_mission(input);
  const auto& mission = loaded.content.mission;
  for (const auto& plan : plans) {
    auto items = items_for(station, input.file, plan, mission);
    if (items.empty() && plan.type != PlanType::mission) continue;
    const auto action = fmt::format("upload of the {}", plan.name);
    const auto count = items.size();
    const bool is_sent = sends_file(station, action, plan, items);
    const auto fact = transfer(station, action, [&](Voice voice) {
      auto& missions = station.client().missions();
      return is_sent ? missions.confirm(station.now(), plan.type, items, voice)
                     : missions.upload(station.now(), plan.type, items, voice);
    });
    if (station.wants_json()) {
      station.json()
          .member("action", "upload")
          .member("plan", plan.name)
          .member("result", "done")
          .member("items", count)
          .member("was_on_board", fact.was_on_board && !is_sent)
          .member("as_file", is_sent);
      station.print();
    } else {
      fmt::print("{}: {} items {}\n", plan.name, count,
                 fact.was_on_board && !is_sent ? "were on board already" : "uploaded, read back, and found equal");
    }
  }
}

void download(Operator& station, const std::string& file) {
  planning::MissionFile content;
  for (const auto& plan : plans) {
    (void)transfer(station, fmt::format("download of the {}", plan.name),
                   [&](Voice voice) { return station.client().missions().download(station.now(), plan.type, voice); });
    const auto* items = station.client().missions().plan(plan.type);
    if (items == nullptr) station.give_up("download", "", "the plan changed while it was read");
    const auto read = autopilot::from_wire(station.client().peer().stack, plan.type, *items, content.mission);
    if (!read)
      station.give_up("download", "", fmt::format("{}: item {}: {}", plan.name, read.error().item, read.error().what));
  }
  if (file.empty()) return print_json(content);
  const auto format = planning::format_of_name(file);
  if (!format) throw UsageError{fmt::format("{}: the name tells no format", file)};
  const auto writing = planning::write_mission_file(*format, content);
  if (!writing) throw Failure{to_text(file, writing.error())};
  save_file(file, writing->bytes);
  for (const auto& loss : writing->losses) fmt::print(stderr, "{}: lost: {}\n", file, loss);
  station.tell_done("download");
}

}  // namespace

void add_mission_actions(CLI::App& command, Action& chosen) {
  auto* mission = command.add_subcommand("mission", "Mission, fence and rally points");
  mission->require_subcommand(1);

  auto input = std::make_shared<MissionInput>();
  auto* upload_action = mission->add_subcommand("upload", "What a file has, read back and compared");
  upload_action->add_option("FILE", input->file, "As for `ponte mission convert`, e.g. QGroundControl's .plan")
      ->required();
  add_mission_input_options(*upload_action, *input);
  upload_action->callback([&chosen, input] { chosen = [input](Operator& station) { upload(station, *input); }; });

  auto file = std::make_shared<std::string>();
  auto* download_action = mission->add_subcommand("download", "What is on board, into a file");
  download_action->add_option("FILE", *file, "Its name tells the format; without one, lines of JSON");
  download_action->callback([&chosen, file] { chosen = [file](Operator& station) { download(station, *file); }; });

  add_simple_action(*mission, chosen, "clear", "Nothing is left on board", [](Operator& station) {
    for (const auto& plan : plans)
      (void)transfer(station, fmt::format("clearing of the {}", plan.name),
                     [&](Voice voice) { return station.client().missions().clear(station.now(), plan.type, voice); });
    station.tell_done("clear");
  });

  auto item = std::make_shared<std::uint16_t>();
  auto* set_action = mission->add_subcommand("set", "Go on with this item");
  set_action->add_option("ITEM", *item, "As the vehicle counts them: from 0, which is home in ArduPilot")->required();
  set_action->callback([&chosen, item] {
    chosen = [item](Operator& station) {
      (void)transfer(station, "set",
                     [&](Voice voice) { return station.client().missions().set_current(station.now(), *item, voice); });
      station.tell_done("set");
    };
  });
}

}  // namespace ponte::app
