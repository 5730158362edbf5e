#include "vehicle/actions.hpp"
#include "vehicle/carry_out.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>

/// Modes, arming, and how a flight begins and ends.
namespace ponte::app {
namespace {

using autopilot::ModeError;
using autopilot::ModeFact;
using vehicle::ModeKind;

/// What the vehicle is about to tell.
bool is_early(ModeError error) { return error == ModeError::not_heard || error == ModeError::home_unknown; }

template <class Begin>
void change(Operator& station, std::string_view action, Begin&& begin) {
  const auto request = station.begin(action, begin, is_early);
  const auto fact = station.await<ModeFact>([&](const ModeFact& each) { return each.request == *request; }, unheeded);
  if (fact.kind == ModeFact::Kind::done) return station.tell_done(action);
  const auto words = fmt::format("{}: {}", to_text(fact.step), to_text(fact.kind));
  station.give_up(action, code_of(fact), with_reason(words, fact.reason.view()));
}

void change_mode(Operator& station, std::string_view action, ModeKind kind) {
  change(station, action,
         [&](autopilot::Voice voice) { return station.client().modes().change_mode(station.now(), kind, voice); });
}

void tell_modes(Operator& station) {
  for (const auto& mode : autopilot::modes_of(station.client().peer().stack)) {
    if (!station.wants_json()) {
      fmt::print("{}\n", mode.name);
      continue;
    }
    station.json().member("mode", mode.name).member("kind", vehicle::name_of(mode.kind));
    station.print();
  }
}

}  // namespace

void add_simple_action(CLI::App& command, Action& chosen, const char* name, const char* description,
                       const Action& act) {
  command.add_subcommand(name, description)->callback([&chosen, act] { chosen = act; });
}

void add_flight_actions(CLI::App& command, Action& chosen) {
  add_simple_action(command, chosen, "arm", "Arm it; nothing is forced past its checks", [](Operator& station) {
    change(station, "arm", [&](autopilot::Voice voice) { return station.client().modes().arm(station.now(), voice); });
  });
  add_simple_action(command, chosen, "disarm", "Disarm it", [](Operator& station) {
    change(station, "disarm",
           [&](autopilot::Voice voice) { return station.client().modes().disarm(station.now(), voice); });
  });

  auto* mode = command.add_subcommand("mode", "Change to a mode of the autopilot; without a name, list them");
  auto name = std::make_shared<std::string>();
  mode->add_option("NAME", *name, "As the autopilot's users call it, e.g. LOITER or AUTO.RTL");
  mode->callback([&chosen, name] {
    chosen = [name](Operator& station) {
      if (name->empty()) return tell_modes(station);
      change(station, "mode " + *name, [&](autopilot::Voice voice) {
        return station.client().modes().change_mode(station.now(), std::string_view{*name}, voice);
      });
    };
  });

  auto* take_off = command.add_subcommand("takeoff", "Arm it and take off");
  auto height = std::make_shared<std::optional<double>>();
  take_off->add_option("HEIGHT", *height, "Metres above home; a plane, and PX4 without it, has its own");
  take_off->callback([&chosen, height] {
    chosen = [height](Operator& station) {
      change(station, "takeoff", [&](autopilot::Voice voice) {
        const auto metres = *height ? std::optional{Metres{**height}} : std::nullopt;
        return station.client().modes().take_off(station.now(), metres, voice);
      });
    };
  });

  add_simple_action(command, chosen, "land", "Land where it is",
                    [](Operator& station) { change_mode(station, "land", ModeKind::land); });
  add_simple_action(command, chosen, "return", "Return home and land there",
                    [](Operator& station) { change_mode(station, "return", ModeKind::return_home); });
  add_simple_action(command, chosen, "hold", "Stay where it is",
                    [](Operator& station) { change_mode(station, "hold", ModeKind::hold); });
  add_simple_action(command, chosen, "start", "Begin or go on with the mission on board; on the ground this arms it",
                    [](Operator& station) {
                      change(station, "start", [&](autopilot::Voice voice) {
                        return station.client().modes().start_mission(station.now(), voice);
                      });
                    });
}

}  // namespace ponte::app
