#pragma once

#include "ponte/planning/formats/format.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>

namespace ponte::app {

/// A file of points or of a mission, and what the user tells of it.
struct MissionInput {
  std::string file;
  std::string format;  ///< empty: to be found out
  std::string poi_layout;
  std::string altitude_above;
  std::optional<double> altitude_m;
  bool bare_polygons_are_inclusions{};  ///< no option: a command knows whether it asks for areas
};

/// The options of a command that reads such a file, all but the file itself.
void add_mission_input_options(CLI::App& command, MissionInput& input);

struct LoadedMission {
  planning::Format format{};
  planning::MissionFile content;
};

/// Reads the file, and prints its remarks to stderr. Throws `Failure`, which says where and what.
[[nodiscard]] LoadedMission load_mission(const MissionInput& input);

/// "a.csv: line 7: latitude is 91: expected -90 to 90".
[[nodiscard]] std::string to_text(const std::string& file, const planning::FormatError& error);

}  // namespace ponte::app
