#include "ponte/planning/separation.hpp"

#include "ponte/planning/plane.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace ponte::planning {
namespace {

using vehicle::Seconds;

constexpr double rounding = 1e-6;

/// A straight part of a flight, which takes no longer than the window.
struct Part {
  double begin{};
  double end{};
  MapPoint from{};
  MapPoint to{};
  double lowest{};
  double highest{};
};

/// What conflicts are looked for in: the whole flight as parts, from its take-off on.
std::vector<Part> parts_of(const Map& map, const Flight& flight, double longest) {
  std::vector<Part> parts;
  for (std::size_t i = 1; i < flight.track.size(); ++i) {
    const auto& before = flight.track[i - 1];
    const auto& after = flight.track[i];
    const auto from = map.point(before.place);
    const auto line = map.point(after.place) - from;
    const auto seconds = (after.time - before.time).count();
    const auto climb = after.height.value - before.height.value;
    const auto count = std::max(1.0, std::ceil(seconds / longest));
    for (double n = 0; n < count; ++n) {
      const auto low = before.height.value + climb * n / count;
      const auto high = before.height.value + climb * (n + 1) / count;
      parts.push_back({before.time.count() + seconds * n / count, before.time.count() + seconds * (n + 1) / count,
                       from + line * (n / count), from + line * ((n + 1) / count), std::min(low, high),
                       std::max(low, high)});
    }
  }
  return parts;
}

/// The first part of `b`, so much later than it says, that comes too near to one of `a`.
std::optional<std::size_t> first_conflict(const std::vector<Part>& a, double a_wait, const std::vector<Part>& b,
                                          double b_wait, const Separation& separation) {
  const auto window = separation.window.count();
  std::size_t earliest = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const auto& part = b[i];
    while (earliest < a.size() && a[earliest].end + a_wait + window < part.begin + b_wait) ++earliest;
    for (auto j = earliest; j < a.size() && a[j].begin + a_wait <= part.end + b_wait + window; ++j) {
      const auto& other = a[j];
      const auto apart = std::max(part.lowest - other.highest, other.lowest - part.highest);
      if (apart > separation.height.value - rounding) continue;
      if (distance_of_lines(part.from, part.to, other.from, other.to) < separation.distance.value) return i;
    }
  }
  return std::nullopt;
}

Map map_of(const std::vector<Flight>& flights) {
  for (const auto& flight : flights)
    if (!flight.track.empty()) return Map{flight.track.front().place};
  return Map{{}};
}

}  // namespace

std::vector<Conflict> conflicts(const std::vector<Flight>& flights, const Separation& separation) {
  const auto map = map_of(flights);
  std::vector<std::vector<Part>> parts;
  std::vector<Conflict> result;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    parts.push_back(parts_of(map, flights[i], separation.window.count()));
    for (std::size_t j = 0; j < i; ++j)
      if (const auto found =
              first_conflict(parts[j], flights[j].wait.count(), parts[i], flights[i].wait.count(), separation)) {
        const auto& part = parts[i][*found];
        result.push_back({j, i, flights[i].wait + Seconds{part.begin}, map.place(part.from)});
      }
  }
  return result;
}

Flight raised(const Flight& flight, const Craft& craft, Metres added) {
  auto result = flight;
  result.added_altitude = result.added_altitude + added;
  const Seconds climb{added.value / craft.vertical_speed.value};
  for (std::size_t i = 1; i < result.track.size(); ++i) {
    auto& moment = result.track[i];
    const bool has_landed = i + 1 == result.track.size();
    moment.time += has_landed ? 2 * climb : climb;
    if (!has_landed) moment.height = moment.height + added;
  }
  if (!result.track.empty()) result.time += 2 * climb;
  return result;
}

void separate(std::vector<Flight>& flights, const std::vector<Craft>& crafts, const Separation& separation) {
  const auto map = map_of(flights);
  const auto window = separation.window.count();
  std::vector<std::vector<Part>> done;
  double all_landed = 0;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    std::vector<std::pair<Flight, std::vector<Part>>> layers;
    for (int layer = 0; layer < std::max(separation.layers_max, 1); ++layer) {
      auto flight = raised(flights[i], crafts[i], separation.height * layer);
      if (layer > 0 && flight.time > crafts[i].endurance) break;
      auto parts = parts_of(map, flight, window);
      layers.emplace_back(std::move(flight), std::move(parts));
    }
    const auto chosen = [&](double wait) -> std::optional<std::size_t> {
      for (std::size_t layer = 0; layer < layers.size(); ++layer) {
        bool is_apart = true;
        for (std::size_t j = 0; j < i && is_apart; ++j)
          is_apart = !first_conflict(done[j], flights[j].wait.count(), layers[layer].second, wait, separation);
        if (is_apart) return layer;
      }
      return std::nullopt;
    };
    // When all others have landed, nobody is in its way.
    double wait = 0;
    auto layer = chosen(wait);
    while (!layer && wait <= all_landed + window) {
      wait += separation.wait.count();
      layer = chosen(wait);
    }
    auto& [flight, parts] = layers[layer.value_or(0)];
    flight.wait = Seconds{wait};
    if (!flight.legs.empty()) all_landed = std::max(all_landed, wait + flight.time.count());
    flights[i] = std::move(flight);
    done.push_back(std::move(parts));
  }
}

}  // namespace ponte::planning
