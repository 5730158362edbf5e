#include "ponte/planning/formats/numbered_items.hpp"

#include "ponte/planning/formats/coordinates.hpp"
#include "ponte/planning/formats/refusal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace ponte::planning {
namespace {

constexpr std::uint16_t do_jump = 177;
using Indexes = std::map<std::size_t, std::size_t>;

Indexes indexes_of(const std::vector<NumberedItem>& items) {
  Indexes indexes;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!indexes.emplace(items[i].number, i).second)
      refuse(items[i].where, fmt::format("the item number {} comes twice", items[i].number), "each number once");
  return indexes;
}

vehicle::Action jump(const NumberedItem& item, const Indexes& indexes) {
  auto command = item.command;
  const auto target = std::ranges::find(indexes, command.parameters[0],
                                        [](const auto& entry) { return static_cast<double>(entry.first); });
  if (target == indexes.end())
    refuse(item.where, fmt::format("it jumps to item {}, which there is not", command.parameters[0]),
           "the number of an item");
  command.parameters[0] = static_cast<double>(target->second);
  auto action = vehicle::interpret(command);
  if (!std::holds_alternative<vehicle::JumpItem>(action))
    refuse(item.where, fmt::format("it jumps {} times", command.parameters[1]), "a number of times up to 65535, or -1");
  return action;
}

vehicle::Action action_of(const NumberedItem& item, const Indexes& indexes) {
  auto command = item.command;
  if (command.command == do_jump) return jump(item, indexes);
  if (vehicle::has_place(command.command) && vehicle::altitude_frame(command.frame)) {
    auto& latitude = command.parameters[4];
    auto& longitude = command.parameters[5];
    const auto is_nothing = [](double degrees) { return degrees == 0 || std::isnan(degrees); };
    if (is_nothing(latitude) && is_nothing(longitude))
      latitude = longitude = std::numeric_limits<double>::quiet_NaN();
    else
      (void)checked_place(latitude, longitude, item.where);
  }
  return vehicle::interpret(command);
}

}  // namespace

std::size_t integer_of(double number, std::size_t highest, std::string_view name, Where where) {
  if (!(number >= 0 && number <= static_cast<double>(highest)) || number != std::floor(number))
    refuse(where, fmt::format("{} is {}", name, number), fmt::format("an integer from 0 to {}", highest));
  return static_cast<std::size_t>(number);
}

void add_items(const std::vector<NumberedItem>& items, Reading& reading) {
  const auto indexes = indexes_of(items);
  std::vector<PlaceInFile> places;
  for (const auto& item : items) {
    auto action = action_of(item, indexes);
    if (const auto* waypoint = std::get_if<vehicle::WaypointItem>(&action))
      places.push_back({waypoint->place, item.where});
    reading.content.mission.items.push_back({.action = std::move(action), .waits = item.waits, .name = item.name});
  }
  std::ranges::move(doubts(places), std::back_inserter(reading.remarks));
}

std::vector<NumberedItem> numbered(const std::vector<vehicle::MissionItem>& items, std::size_t first) {
  std::vector<NumberedItem> result;
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto command = vehicle::express(items[i].action);
    if (command.command == do_jump) command.parameters[0] += static_cast<double>(first);
    result.push_back(
        {.number = first + i, .command = command, .waits = items[i].waits, .name = items[i].name, .where = {}});
  }
  return result;
}

}  // namespace ponte::planning
