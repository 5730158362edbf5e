#pragma once

#include "ponte/core/result.hpp"
#include "ponte/planning/formats/mission_file.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ponte::planning {

struct CsvRow {
  std::size_t line{};  ///< where it begins, from 1
  std::vector<std::string> cells;
};

/// Splits text after RFC 4180: cells in double quotes may hold separators, line ends and doubled quotes. Rows without
/// anything but white space are left out.
[[nodiscard]] Result<std::vector<CsvRow>, FormatError> split_csv(std::string_view text, char separator);

/// The text as one cell, in quotes where it needs them.
[[nodiscard]] std::string csv_cell(std::string_view text);

}  // namespace ponte::planning
