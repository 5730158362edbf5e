#include "common/number_list.hpp"
#include "ponte/core/degrees.hpp"
#include "vehicle/actions.hpp"
#include "vehicle/carry_out.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>

/// Leading a vehicle that is in the air.
namespace ponte::app {
namespace {

using autopilot::GuidedError;
using autopilot::GuidedWish;
using autopilot::StreamError;
using autopilot::StreamFact;
using autopilot::Target;
using autopilot::Voice;

bool is_early(GuidedError error) {
  return error == GuidedError::home_unknown || error == GuidedError::position_unknown;
}

template <class Begin>
void lead(Operator& station, std::string_view action, Begin&& begin) {
  carry_out<GuidedWish>(station, action, begin, is_early);
}

Target target_from(const std::string& text) {
  const auto numbers = numbers_in(text, 3, 3);
  if (!numbers) throw UsageError{fmt::format("{}: expected LAT,LON,HEIGHT: degrees, and metres above home", text)};
  const Target target{
      radians_from_degrees((*numbers)[0]), radians_from_degrees((*numbers)[1]), {Metres{(*numbers)[2]}}};
  if (!is_valid(target)) throw UsageError{fmt::format("{}: expected a place on Earth", text)};
  return target;
}

/// Feeds the stream of setpoints until that time, or until it has something to tell.
std::optional<StreamFact> feed(Operator& station, const autopilot::Motion& motion, Timestamp until) {
  constexpr Duration interval = std::chrono::milliseconds{200};
  while (station.now() < until) {
    const auto steer = [&](Voice voice) { return station.client().stream().steer(station.now(), motion, voice); };
    (void)station.begin("velocity", steer, [](StreamError error) { return error == StreamError::on_the_ground; });
    station.run_for(interval);
    if (auto fact = station.next<StreamFact>()) return fact;
  }
  return std::nullopt;
}

void fly_at(Operator& station, const autopilot::Motion& motion, Duration duration) {
  constexpr Duration longest_switch = std::chrono::seconds{30};  // the stream gives up before
  auto fact = feed(station, motion, station.now() + longest_switch);
  if (fact && fact->kind == StreamFact::Kind::steers) {
    fact = feed(station, motion, station.now() + duration);
    station.client().stream().stop(station.now());
    if (!fact) fact = station.await<StreamFact>([](const StreamFact&) { return true; }, unheeded);
  }
  if (fact && fact->kind == StreamFact::Kind::held) return station.tell_done("velocity");
  if (!fact) station.give_up("velocity", "", "the vehicle does not enter its mode for it");
  station.give_up("velocity", code_of(*fact), with_reason(to_text(fact->kind), fact->reason.view()));
}

/// A subcommand with one number, which `begin(guided, now, number, voice)` wishes for.
template <class Begin>
void add_number_action(CLI::App& command, Action& chosen, const char* name, const char* description, const char* label,
                       const char* means, Begin begin) {
  auto* action = command.add_subcommand(name, description);
  auto number = std::make_shared<double>();
  action->add_option(label, *number, means)->required();
  action->callback([&chosen, name, number, begin] {
    chosen = [name, number, begin](Operator& station) {
      lead(station, name, [&](Voice voice) { return begin(station.client().guided(), station.now(), *number, voice); });
    };
  });
}

std::optional<MetresPerSecond> speed_from(const std::optional<double>& option) {
  return option ? std::optional{MetresPerSecond{*option}} : std::nullopt;
}

void add_goto(CLI::App& command, Action& chosen) {
  struct Options {
    std::string place;
    std::optional<double> speed;
  };
  auto options = std::make_shared<Options>();
  auto* action = command.add_subcommand("goto", "Fly to a place, and stay there");
  action->add_option("PLACE", options->place, "LAT,LON,HEIGHT: degrees, and metres above home")->required();
  action->add_option("--speed", options->speed, "Metres per second");
  action->callback([&chosen, options] {
    chosen = [options, target = target_from(options->place)](Operator& station) {
      lead(station, "goto", [&](Voice voice) {
        return station.client().guided().go_to(station.now(), target, speed_from(options->speed), voice);
      });
    };
  });
}

void add_orbit(CLI::App& command, Action& chosen) {
  struct Options {
    std::string centre;
    double radius{};
    std::optional<double> speed;
  };
  auto options = std::make_shared<Options>();
  auto* action = command.add_subcommand("orbit", "Fly round a place");
  action->add_option("PLACE", options->centre, "LAT,LON,HEIGHT: degrees, and metres above home")->required();
  action->add_option("RADIUS", options->radius, "Metres, clockwise if positive")->required();
  action->add_option("--speed", options->speed, "Metres per second");
  action->callback([&chosen, options] {
    chosen = [options, centre = target_from(options->centre)](Operator& station) {
      lead(station, "orbit", [&](Voice voice) {
        return station.client().guided().orbit(station.now(), centre, Metres{options->radius},
                                               speed_from(options->speed), voice);
      });
    };
  });
}

void add_velocity(CLI::App& command, Action& chosen) {
  struct Options {
    std::string velocity;
    double seconds{};
  };
  auto options = std::make_shared<Options>();
  auto* action = command.add_subcommand("velocity", "Move a copter for a while, and hold it");
  action->add_option("VELOCITY", options->velocity, "NORTH,EAST,DOWN in metres per second")->required();
  action->add_option("SECONDS", options->seconds, "For how long")->required()->check(CLI::Range(0.1, 3600.0));
  action->callback([&chosen, options] {
    const auto numbers = numbers_in(options->velocity, 3, 3);
    if (!numbers) throw UsageError{fmt::format("{}: expected NORTH,EAST,DOWN in m/s", options->velocity)};
    const autopilot::Motion motion{
        MetresPerSecond{(*numbers)[0]}, MetresPerSecond{(*numbers)[1]}, MetresPerSecond{(*numbers)[2]}, {}};
    chosen = [motion, seconds = options->seconds](Operator& station) {
      fly_at(station, motion, std::chrono::duration_cast<Duration>(std::chrono::duration<double>{seconds}));
    };
  });
}

}  // namespace

void add_guided_actions(CLI::App& command, Action& chosen) {
  using autopilot::GuidedFlight;
  using autopilot::Height;
  add_goto(command, chosen);
  add_orbit(command, chosen);
  add_number_action(command, chosen, "altitude", "Climb or descend, and stay there", "HEIGHT", "Metres above home",
                    [](GuidedFlight& guided, Timestamp now, double metres, Voice& voice) {
                      return guided.change_altitude(now, Height{Metres{metres}, Height::Above::home}, voice);
                    });
  add_number_action(command, chosen, "heading", "Turn the nose of a copter", "DEGREES", "Clockwise from north",
                    [](GuidedFlight& guided, Timestamp now, double degrees, Voice& voice) {
                      return guided.turn_to(now, radians_from_degrees(degrees), voice);
                    });
  add_number_action(command, chosen, "speed", "Fly at another speed", "SPEED",
                    "Metres per second over ground; a plane's of ArduPilot through the air",
                    [](GuidedFlight& guided, Timestamp now, double speed, Voice& voice) {
                      return guided.change_speed(now, MetresPerSecond{speed}, voice);
                    });
  add_velocity(command, chosen);
}

}  // namespace ponte::app
