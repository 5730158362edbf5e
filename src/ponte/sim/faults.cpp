#include "ponte/sim/faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace ponte::sim {
namespace {

using enum FaultKind;

struct FaultName {
  FaultKind kind;
  std::string_view name;
  bool may_pass;
};

constexpr std::array names{
    FaultName{battery_low, "battery-low", false},
    FaultName{battery_critical, "battery-critical", false},
    FaultName{gps_loss, "gps-loss", true},
    FaultName{link_loss, "link-loss", true},
    FaultName{motor, "motor", true},
    FaultName{reboot, "reboot", false},
};

constexpr double longest_s = 1e7;

std::string all_names() {
  std::string result;
  for (const auto& each : names) result += (result.empty() ? "" : ", ") + std::string{each.name};
  return result;
}

/// "60s", "1.5min", "200ms", "60".
std::optional<Duration> parse_time(std::string_view text) {
  double number{};
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
  if (error != std::errc{}) return std::nullopt;
  const std::string_view unit{after, static_cast<std::size_t>(end - after)};
  const double scale = unit == "ms" ? 1e-3 : unit == "min" ? 60 : 1;
  if (!unit.empty() && unit != "s" && unit != "ms" && unit != "min") return std::nullopt;
  const double seconds = number * scale;
  if (!(seconds >= 0 && seconds <= longest_s)) return std::nullopt;
  return Duration{std::llround(seconds * 1e9)};
}

}  // namespace

Result<Fault, std::string> parse_fault(std::string_view text, Duration now) {
  const auto name = text.substr(0, text.find_first_of("@+"));
  const auto found = std::ranges::find(names, name, &FaultName::name);
  if (found == names.end())
    return fail(fmt::format("{}: no fault is called '{}'; there are {}", text, name, all_names()));

  Fault fault{.kind = found->kind, .at = now};
  auto rest = text.substr(name.size());
  const auto plus = rest.find('+');
  if (rest.starts_with('@')) {
    const auto at = parse_time(rest.substr(1, plus == std::string_view::npos ? plus : plus - 1));
    if (!at) return fail(fmt::format("{}: expected a time after @, as in 90s, 500ms or 2min", text));
    fault.at = *at;
  }
  if (plus == std::string_view::npos) return fault;
  if (!found->may_pass) return fail(fmt::format("{}: {} does not pass, so it has no duration", text, name));
  fault.lasts = parse_time(rest.substr(plus + 1));
  if (!fault.lasts) return fail(fmt::format("{}: expected a duration after +, as in 20s", text));
  return fault;
}

Result<std::vector<Fault>, std::string> parse_faults(std::string_view text) {
  std::vector<Fault> faults;
  while (true) {
    const auto comma = text.find(',');
    const auto part = text.substr(0, comma);
    if (part.find('@') == std::string_view::npos)
      return fail(fmt::format("'{}': expected FAULT@TIME, as in gps-loss@90s+20s; there are {}", part, all_names()));
    auto fault = parse_fault(part, {});
    if (!fault) return fail(std::move(fault.error()));
    faults.push_back(*fault);
    if (comma == std::string_view::npos) return faults;
    text.remove_prefix(comma + 1);
  }
}

bool Faults::is_on(FaultKind kind, Duration now) const {
  return std::ranges::any_of(faults_, [=](const Fault& each) {
    return each.kind == kind && each.at <= now && (!each.lasts || now < each.at + *each.lasts);
  });
}

bool Faults::begins(FaultKind kind, Duration from, Duration until) const {
  return std::ranges::any_of(
      faults_, [=](const Fault& each) { return each.kind == kind && from <= each.at && each.at < until; });
}

}  // namespace ponte::sim
