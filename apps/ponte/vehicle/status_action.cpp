#include "ponte/core/degrees.hpp"
#include "vehicle/actions.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <concepts>
#include <memory>

/// What is known of the vehicle and of the link to it.
namespace ponte::app {
namespace {

constexpr Duration once_a_second = std::chrono::seconds{1};
constexpr Duration long_enough = std::chrono::seconds{3};  // for what comes once a second, some of it lost

double milliseconds_of(Duration duration) { return std::chrono::duration<double, std::milli>{duration}.count(); }

/// Prints what has a name, a value and perhaps a unit: as members of a JSON object in SI units, or as lines, angles in
/// degrees.
class Printer {
 public:
  explicit Printer(JsonText* json) : json_{json} {}

  template <class T>
  void value(std::string_view name, const T& value) {
    if constexpr (std::same_as<T, Radians> || std::same_as<T, RadiansPerSecond>)
      number(name, value.value, degrees_from_radians(Radians{value.value}), T::unit::symbol == "rad" ? "deg" : "deg/s");
    else if constexpr (requires { T::unit::symbol; })
      number(name, value.value, value.value, T::unit::symbol);
    else if constexpr (std::same_as<T, vehicle::Mode>)
      text(name, value.name.view());
    else if constexpr (std::same_as<T, vehicle::Phase>)
      text(name, vehicle::name_of(value));
    else if constexpr (requires { value.view(); })
      text(name, value.view());
  }

  void number(std::string_view name, double value, double shown, std::string_view unit) {
    if (json_ != nullptr)
      json_->member(name, value);
    else
      fmt::print("{:<30} {:.7g} {}\n", name, shown, unit);
  }
  void text(std::string_view name, std::string_view words) {
    if (json_ != nullptr)
      json_->member(name, words);
    else
      fmt::print("{:<30} {}\n", name, words);
  }

 private:
  JsonText* json_;
};

void tell(Operator& station) {
  Printer printer{station.wants_json() ? &station.json() : nullptr};
  const auto& state = station.state();
  vehicle::visit_facts([&](auto fact, std::string_view name, std::string_view, std::string_view) {
    if (const auto& known = state.*fact) printer.value(name, known.value());
  });
  for (std::size_t i = 0; i < vehicle::subsystem_count; ++i)
    if (state.subsystems[i])
      printer.text(fmt::format("{}_condition", name_of(static_cast<vehicle::Subsystem>(i))),
                   name_of(state.subsystems[i].value()));
  const auto& quality = station.client().link_quality();
  if (const auto loss = quality.loss(station.now())) printer.value("link_loss", *loss);
  printer.number("link_frames", quality.frames_per_second(station.now()), quality.frames_per_second(station.now()),
                 "1/s");
  if (const auto round_trip = station.client().time_sync().round_trip())
    printer.number("link_round_trip_ms", milliseconds_of(*round_trip), milliseconds_of(*round_trip), "ms");
  if (station.wants_json())
    station.print();
  else
    fmt::print("\n");
  std::fflush(stdout);
}

}  // namespace

void add_status_action(CLI::App& command, Action& chosen) {
  auto watches = std::make_shared<bool>();
  auto* action = command.add_subcommand("status", "What is known of it and of the link");
  action->add_flag("--watch", *watches, "Again each second, until it is interrupted");
  action->callback([&chosen, watches] {
    chosen = [watches](Operator& station) {
      station.run_for(long_enough);
      tell(station);
      while (*watches) {
        station.run_for(once_a_second);
        tell(station);
      }
    };
  });
}

}  // namespace ponte::app
