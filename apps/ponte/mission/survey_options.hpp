#pragma once

#include "ponte/planning/task.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ponte::app {

/// What the user of `ponte mission plan` says of areas and corridors to take pictures of.
struct SurveyOptions {
  std::vector<std::string> areas;      ///< files
  std::vector<std::string> corridors;  ///< files
  double width_m{};
  std::string camera;
  std::optional<double> gsd_cm;
  double side_overlap_percent{70};
  double front_overlap_percent{70};
  double turnaround_m{20};
  std::optional<double> angle_deg;

  [[nodiscard]] bool is_wanted() const { return !areas.empty() || !corridors.empty(); }
};

void add_survey_options(CLI::App& command, SurveyOptions& options);

/// At which the pictures have the resolution that is asked; nothing where none is.
[[nodiscard]] std::optional<Metres> survey_altitude(const SurveyOptions& options);

/// Adds the lines to the task, whose altitude is known, and the zones of the files to its fence; and says on stderr
/// what the pictures show. Throws `Failure` with the file, and `UsageError` for options that cannot be meant.
void add_survey(const SurveyOptions& options, planning::Task& task);

}  // namespace ponte::app
