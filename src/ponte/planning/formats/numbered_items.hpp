#pragma once

#include "ponte/planning/formats/mission_file.hpp"
#include "ponte/vehicle/mission_command.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Mission items as `.plan` and WPL have them: with numbers that jumps lead to.
namespace ponte::planning {

struct NumberedItem {
  std::size_t number{};
  vehicle::MissionCommand command{};  ///< a jump's parameter 1 is a number
  bool waits{};
  std::string name{};
  Where where{};
};

/// The number as an integer from 0 to `highest`. Throws `FormatError`, which says that the value of this name is wrong.
[[nodiscard]] std::size_t integer_of(double number, std::size_t highest, std::string_view name, Where where);

/// Adds the items to the mission, and doubts about their places to the remarks. Throws `FormatError` for a place that
/// is none, a number that comes twice, and a jump to an item that there is not.
void add_items(const std::vector<NumberedItem>& items, Reading& reading);

/// The items to write, the first of them with this number.
[[nodiscard]] std::vector<NumberedItem> numbered(const std::vector<vehicle::MissionItem>& items, std::size_t first);

}  // namespace ponte::planning
