#include "ponte/planning/formats/point_draft.hpp"

#include "ponte/planning/formats/coordinates.hpp"
#include "ponte/planning/formats/refusal.hpp"
#include "ponte/planning/formats/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace ponte::planning {
namespace {

constexpr double no_limit = std::numeric_limits<double>::max();

/// Control characters that XML has no way to say.
bool is_forbidden_control(char c) { return c >= 0 && c < 0x20 && c != '\t' && c != '\n' && c != '\r'; }

}  // namespace

std::string_view name_of(vehicle::AltitudeFrame frame) {
  constexpr std::array<std::string_view, 3> names{"msl", "home", "terrain"};
  return names[static_cast<std::size_t>(frame)];
}

bool PointDraft::knows(std::string_view name) {
  constexpr std::array names{name_name,  altitude_name, altitude_above_name,
                             dwell_name, priority_name, sensor_quality_name};
  return std::ranges::find(names, name) != names.end();
}

void PointDraft::set(std::string_view name, std::string_view value) {
  if (name == name_name) {
    const auto control = std::ranges::find_if(value, is_forbidden_control);
    if (control != value.end())
      refuse(point_.where, fmt::format("the name holds the control character {}", static_cast<int>(*control)), "text");
    point_.name = value;
  } else if (name == altitude_name) {
    const auto metres = number_in(value);
    if (!metres) refuse(point_.where, fmt::format("altitude is '{}'", value), "metres");
    altitude_ = *metres;
  } else if (name == altitude_above_name) {
    for (const auto frame : altitude_frames)
      if (name_of(frame) == value) above_ = frame;
    if (!above_) refuse(point_.where, fmt::format("altitude_above is '{}'", value), "msl, home or terrain");
  } else if (name == dwell_name) {
    point_.dwell = vehicle::Seconds{number(name, value, no_limit)};
  } else if (name == priority_name) {
    point_.priority = number(name, value, no_limit);
  } else if (name == sensor_quality_name) {
    point_.sensor_quality = number(name, value, 1);
  }
}

PointOfInterest PointDraft::finish(std::optional<vehicle::AltitudeFrame> untold) const {
  auto point = point_;
  if (!altitude_) return point;
  const auto above = above_ ? above_ : untold;
  if (!above)
    refuse(point.where, fmt::format("the altitude {} counts from no one knows where", *altitude_),
           "altitude_above to be msl, home or terrain (or --altitude-above)");
  point.altitude = vehicle::Altitude{Metres{*altitude_}, *above};
  return point;
}

double PointDraft::number(std::string_view name, std::string_view value, double highest) const {
  const auto number = number_in(value);
  if (!number || *number < 0 || *number > highest)
    refuse(point_.where, fmt::format("{} is '{}'", name, value),
           highest == no_limit ? "a number of at least 0" : fmt::format("a number from 0 to {}", highest));
  return *number;
}

}  // namespace ponte::planning
