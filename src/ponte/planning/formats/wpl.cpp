#include "ponte/planning/formats/wpl.hpp"

#include "ponte/planning/formats/conversion.hpp"
#include "ponte/planning/formats/coordinates.hpp"
#include "ponte/planning/formats/losses.hpp"
#include "ponte/planning/formats/numbered_items.hpp"
#include "ponte/planning/formats/refusal.hpp"
#include "ponte/planning/formats/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace ponte::planning {
namespace {

constexpr std::size_t field_count = 12;
constexpr std::size_t highest_number = 65535;

/// Its fields between white space: no field is ever empty, so that tabs and spaces need no telling apart.
std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  constexpr std::string_view space = " \t\r";
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(space), line.size()));
    if (line.empty()) return fields;
    const auto length = std::min(line.find_first_of(space), line.size());
    fields.emplace_back(line.substr(0, length));
    line.remove_prefix(length);
  }
}

class WplReader {
 public:
  Reading read(std::string_view text) {
    const auto header = trimmed(text.substr(0, text.find('\n')));
    if (header != "QGC WPL 110" && header != "QGC WPL 120")
      refuse(at_line(1), fmt::format("the first line is '{}'", header.substr(0, 40)), "QGC WPL 110, or 120");
    has_home_ = header == "QGC WPL 110";
    for (std::size_t line = 2; text.find('\n') != text.npos; ++line) {
      text.remove_prefix(text.find('\n') + 1);
      read_line(trimmed(text.substr(0, text.find('\n'))), at_line(line));
    }
    if (!name_.empty()) remark(at_line(1), "the comment after the last item is not kept");
    add_items(items_, reading_);
    return std::move(reading_);
  }

 private:
  void remark(Where where, std::string text) { reading_.remarks.push_back({where, std::move(text)}); }

  void read_line(std::string_view line, Where where) {
    if (line.starts_with('#')) {
      if (!name_.empty()) remark(where, fmt::format("it takes the place of the comment before it, '{}'", name_));
      name_ = trimmed(line.substr(1));
    } else if (!line.empty()) {
      read_item(line, where);
    }
  }

  void read_item(std::string_view line, Where where) {
    const auto fields = fields_of(line);
    if (fields.size() != field_count)
      refuse(where, fmt::format("it has {} fields", fields.size()),
             "12: index, current, frame, command, four parameters, latitude, longitude, altitude, autocontinue");
    const auto integer = [&](std::size_t field, std::size_t highest, std::string_view name) {
      return integer_of(number(fields[field], name, where), highest, name, where);
    };
    NumberedItem item{.number = integer(0, highest_number, "index"), .command = {}, .name = {}, .where = where};
    const bool is_current = integer(1, 1, "current") == 1;
    item.command.frame = static_cast<std::uint8_t>(integer(2, 255, "frame"));
    item.command.command = static_cast<std::uint16_t>(integer(3, highest_number, "command"));
    for (std::size_t i = 0; i < item.command.parameters.size(); ++i)
      item.command.parameters[i] = parameter(fields[4 + i], i, where);
    item.waits = integer(11, 1, "autocontinue") == 0;
    item.name = std::exchange(name_, {});
    if (is_home(item)) {
      take_home(item);
      return;
    }
    if (is_current && !items_.empty()) remark(where, "that the mission begins with this item is not kept");
    items_.push_back(std::move(item));
  }

  /// "Not a number" leaves a parameter to the vehicle. A decimal comma cannot be anything else here.
  double parameter(std::string_view field, std::size_t index, Where where) {
    if (lower_case(field) == "nan") return std::numeric_limits<double>::quiet_NaN();
    constexpr std::array<std::string_view, 7> names{"parameter 1", "parameter 2", "parameter 3", "parameter 4",
                                                    "latitude",    "longitude",   "altitude"};
    return number(field, names[index], where);
  }

  double number(std::string_view field, std::string_view name, Where where) {
    std::string text{field};
    if (const auto comma = text.find(','); comma != text.npos) {
      text[comma] = '.';
      if (!std::exchange(commas_remarked_, true)) remark(where, "its numbers are written with decimal commas");
    }
    const auto value = number_in(text);
    if (!value) refuse(where, fmt::format("{} is '{}'", name, field), "a number");
    return *value;
  }

  /// Mission Planner gives it command 0 when it has not been set.
  [[nodiscard]] bool is_home(const NumberedItem& item) const {
    constexpr std::uint16_t nav_waypoint = 16;
    return has_home_ && items_.empty() && item.number == 0 && item.command.frame == 0 &&
           (item.command.command == nav_waypoint || item.command.command == 0);
  }

  void take_home(const NumberedItem& item) {
    const auto& p = item.command.parameters;
    if (p[4] == 0 && p[5] == 0) return;
    const auto place = checked_place(p[4], p[5], item.where);
    reading_.content.mission.home = vehicle::Home{place, Metres{std::isnan(p[6]) ? 0 : p[6]}};
  }

  bool has_home_{};
  std::string name_;  ///< of the item that comes next
  bool commas_remarked_{};
  std::vector<NumberedItem> items_;
  Reading reading_;
};

/// "NaN" is spelt so that Mission Planner, QGroundControl and pymavlink read it.
std::string field_text(double number) { return std::isnan(number) ? "NaN" : decimal_text(number); }

void append_line(std::string& text, const NumberedItem& item, bool is_current) {
  text += fmt::format("{}\t{}\t{}\t{}", item.number, is_current ? 1 : 0, item.command.frame, item.command.command);
  const bool may_lack_place =
      vehicle::has_place(item.command.command) && vehicle::altitude_frame(item.command.frame).has_value();
  for (std::size_t i = 0; i < item.command.parameters.size(); ++i) {
    const bool is_absent_place = may_lack_place && (i == 4 || i == 5) && std::isnan(item.command.parameters[i]);
    text += '\t' + (is_absent_place ? "0" : field_text(item.command.parameters[i]));
  }
  text += fmt::format("\t{}\n", item.waits ? 0 : 1);
}

NumberedItem home_item(const std::optional<vehicle::Home>& home) {
  const vehicle::Home at = home.value_or(vehicle::Home{});
  const vehicle::WaypointItem item{
      .place = at.place, .altitude = {at.altitude_msl, vehicle::AltitudeFrame::msl}, .yaw = Radians{}};
  return {.number = 0, .command = vehicle::express(item), .name = {}, .where = {}};
}

std::vector<std::string> losses_of(const vehicle::Mission& mission) {
  Losses losses;
  for (std::size_t i = 0; i < mission.items.size(); ++i)
    if (!mission.items[i].name.empty()) losses.add("name", "item", i + 1);
  for (const auto& pattern : mission.patterns)
    losses.add(pattern.count == 0
                   ? fmt::format("the whole pattern {}, whose file does not tell what items it makes", pattern.kind)
                   : fmt::format("that items {} to {} are a pattern {}", pattern.first + 1,
                                 pattern.first + pattern.count, pattern.kind));
  lose_zones(mission, false, losses);
  lose_settings(mission, losses);
  return losses.told();
}

}  // namespace

ReadingResult read_wpl(Bytes bytes, const ReadOptions&) try {
  return WplReader{}.read(text_in(bytes));
} catch (const FormatError& error) {
  return fail(error);
}

Result<Writing, FormatError> write_wpl(const MissionFile& content) {
  auto to_write = mission_for(content);
  if (!to_write) return fail(to_write.error());
  const auto& mission = to_write->mission;
  std::string text = "QGC WPL 110\n";
  append_line(text, home_item(mission.home), true);
  for (const auto& item : numbered(mission.items, 1)) append_line(text, item, false);
  auto losses = std::move(to_write->losses);
  std::ranges::move(losses_of(mission), std::back_inserter(losses));
  return Writing{bytes_from(text), std::move(losses)};
}

}  // namespace ponte::planning
