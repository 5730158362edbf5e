#pragma once

#include "mission/mission_input.hpp"
#include "mission/survey_options.hpp"
#include "ponte/planning/task.hpp"

#include <CLI/App.hpp>

#include <string>
#include <vector>

namespace ponte::app {

/// What the user of `ponte mission plan` says.
struct PlanOptions {
  MissionInput input;
  SurveyOptions survey;
  std::vector<std::string> outputs;
  std::string map;
  std::string order{"best"};
  std::string objective{"total"};
  std::string solver{"best"};
  std::string end{"return"};
  std::vector<std::string> vehicles;
  std::vector<std::string> fences;
  std::string wind;
  std::optional<double> speed;
  double turn_radius_m{};
  double vertical_speed{2};
  double endurance_s{};
  double reserve_percent{20};
  double margin_m{10};
  double altitude_max_m{120};
  double altitude_min_m{5};
  double separation_m{20};
  double layer_m{10};
  std::string separate_by{"altitude"};
  double window_s{10};
  double wait_s{15};
  double seconds{2};
  std::uint64_t tries{200'000};
  std::uint64_t seed{1};
  bool pictures{};
  bool json{};
  bool quiet{};
};

void add_plan_options(CLI::App& command, PlanOptions& options);

/// The task that the options and their files make. Throws `UsageError` for options that cannot be meant, `Failure` for
/// files that hold nothing to plan for.
[[nodiscard]] planning::Task task_from(const PlanOptions& options);

}  // namespace ponte::app
