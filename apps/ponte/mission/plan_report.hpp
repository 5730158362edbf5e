#pragma once

#include "mission/plan_options.hpp"
#include "ponte/planning/flight_plan.hpp"
#include "ponte/planning/separation.hpp"

namespace ponte::app {

// What `ponte mission plan` says of its plan: lines of text, or one JSON object for each.

/// Of all that tell it in the frame of the task's, metres.
[[nodiscard]] double highest_altitude(const planning::Task& task);

/// Throws `Failure` for one that is beyond the limits.
void check_altitudes(const PlanOptions& options, const planning::Task& task);

void report_conflicts(const PlanOptions& options, const std::vector<planning::Conflict>& conflicts);
void report_vehicle(const PlanOptions& options, const planning::Task& task, std::size_t index,
                    const planning::Flight& flight, const vehicle::Mission& mission);
void report_unvisited(const PlanOptions& options, const planning::FlightPlanner& planner, const planning::Plan& plan);

}  // namespace ponte::app
