#pragma once

#include "ponte/planning/flight_plan.hpp"

#include <string>

namespace ponte::app {

/// A page that shows points, survey lines, zones and routes, north up; it needs nothing from elsewhere.
[[nodiscard]] std::string map_page(const planning::Task& task, const std::vector<planning::Flight>& flights);

}  // namespace ponte::app
