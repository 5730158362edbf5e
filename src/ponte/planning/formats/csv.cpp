#include "ponte/planning/formats/csv.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/planning/formats/conversion.hpp"
#include "ponte/planning/formats/coordinates.hpp"
#include "ponte/planning/formats/csv_rows.hpp"
#include "ponte/planning/formats/point_draft.hpp"
#include "ponte/planning/formats/refusal.hpp"
#include "ponte/planning/formats/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace ponte::planning {
namespace {

constexpr std::string_view latitude_name = "latitude";
constexpr std::string_view longitude_name = "longitude";

/// Other names that tables use for our columns.
constexpr std::pair<std::string_view, std::string_view> synonyms[]{
    {"lat", latitude_name},           {"y", latitude_name},     {"lon", longitude_name},
    {"lng", longitude_name},          {"long", longitude_name}, {"x", longitude_name},
    {"alt", altitude_name},           {"z", altitude_name},     {"dwell", dwell_name},
    {"quality", sensor_quality_name},
};

std::string column_name(std::string_view header) {
  const auto name = lower_case(trimmed(header.substr(0, header.find_first_of("(["))));
  for (const auto& [other, ours] : synonyms)
    if (name == other) return std::string{ours};
  return name;
}

std::vector<std::string> column_names(const CsvRow& header) {
  std::vector<std::string> names;
  for (const auto& cell : header.cells) names.push_back(column_name(cell));
  return names;
}

/// A number with one decimal comma gets a dot. Refuses a table that uses both marks.
class DecimalMarks {
 public:
  std::string normalised(std::string_view number, Where where) {
    std::string result{number};
    const auto comma = result.find(',');
    const auto mark = comma != std::string::npos ? ',' : result.find('.') != std::string::npos ? '.' : ' ';
    if (mark == ' ') return result;
    if (mark_ && *mark_ != mark)
      refuse(where, fmt::format("'{}' has another decimal mark than the numbers before it", number),
             "the same mark in all numbers");
    mark_ = mark;
    if (comma != std::string::npos) result[comma] = '.';
    return result;
  }

 private:
  std::optional<char> mark_;
};

/// Reads the rows below a header.
class TableReader {
 public:
  TableReader(const CsvRow& header, std::vector<std::string> columns, const ReadOptions& options, bool decimal_commas)
      : columns_{std::move(columns)}, options_{options}, decimal_commas_{decimal_commas} {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (!columns_[i].empty() && std::ranges::count(columns_, columns_[i]) > 1)
        refuse(at_line(header.line), fmt::format("the column {} comes twice", columns_[i]), "each column once");
      if (!is_known(columns_[i]))
        reading_.remarks.push_back(
            {at_line(header.line), fmt::format("the column '{}' is not kept", trimmed(header.cells[i]))});
    }
  }

  void read(const CsvRow& row) {
    const auto where = at_line(row.line);
    const auto last_filled = std::ranges::find_if(row.cells.rbegin(), row.cells.rend(),
                                                  [](std::string_view cell) { return !trimmed(cell).empty(); });
    const auto filled = static_cast<std::size_t>(row.cells.rend() - last_filled);
    if (filled > columns_.size())
      refuse(where, fmt::format("it has {} cells, the header {}", filled, columns_.size()),
             "as many as the header; with decimal commas, semicolons between the cells");
    PointDraft draft{where};
    std::optional<double> latitude;
    std::optional<double> longitude;
    for (std::size_t i = 0; i < filled; ++i) {
      const auto cell = trimmed(row.cells[i]);
      if (columns_[i] == latitude_name)
        latitude = degrees(latitude_name, cell, where);
      else if (columns_[i] == longitude_name)
        longitude = degrees(longitude_name, cell, where);
      else if (columns_[i] == name_name)
        draft.set(name_name, row.cells[i]);
      else if (!cell.empty() && is_known(columns_[i]))
        draft.set(columns_[i], columns_[i] == altitude_above_name ? std::string{cell} : marked(cell, where));
    }
    if (!latitude || !longitude) refuse(where, "latitude or longitude is missing", "decimal degrees");
    draft.set_place(checked_place(*latitude, *longitude, where));
    reading_.content.points.push_back(draft.finish(options_.altitude_above));
  }

  Reading finish() {
    std::ranges::move(doubts(reading_.content.points), std::back_inserter(reading_.remarks));
    return std::move(reading_);
  }

 private:
  static bool is_known(std::string_view column) {
    return column == latitude_name || column == longitude_name || PointDraft::knows(column);
  }

  std::string marked(std::string_view cell, Where where) {
    return decimal_commas_ ? marks_.normalised(cell, where) : std::string{cell};
  }

  double degrees(std::string_view name, std::string_view cell, Where where) {
    const auto number = number_in(marked(cell, where));
    if (!number) refuse(where, fmt::format("{} is '{}'", name, cell), "decimal degrees");
    return *number;
  }

  std::vector<std::string> columns_;
  const ReadOptions& options_;
  bool decimal_commas_;
  DecimalMarks marks_;
  Reading reading_;
};

bool has_places(const std::vector<std::string>& columns) {
  return std::ranges::find(columns, latitude_name) != columns.end() &&
         std::ranges::find(columns, longitude_name) != columns.end();
}

Reading read_table(std::string_view text, const ReadOptions& options) {
  for (const char separator : {',', ';', '\t'}) {
    const auto header =
        split_csv(text.substr(0, text.find_first_of("\r\n", text.find_first_not_of("\r\n"))), separator);
    if (!header || header->empty()) continue;
    auto columns = column_names(header->front());
    if (!has_places(columns)) continue;
    const auto rows = split_csv(text, separator);
    if (!rows) throw FormatError{rows.error()};
    TableReader reader{rows->front(), std::move(columns), options, separator != ','};
    for (std::size_t i = 1; i < rows->size(); ++i) reader.read((*rows)[i]);
    if (rows->size() == 1)
      refuse(at_line(rows->front().line), "there is nothing but the header", "a row for each point");
    return reader.finish();
  }
  refuse(at_line(1), "the first line names no latitude and longitude", "a header such as latitude,longitude,altitude");
}

}  // namespace

ReadingResult read_csv(Bytes bytes, const ReadOptions& options) try {
  return read_table(text_in(bytes), options);
} catch (const FormatError& error) {
  return fail(error);
}

Writing write_csv(const MissionFile& content) {
  auto [points, losses] = points_for(content, {.msl_altitude = true,
                                               .other_altitudes = true,
                                               .dwell = true,
                                               .priority = true,
                                               .sensor_quality = true,
                                               .name = true});
  auto text = fmt::format("{},{},{},{},{},{},{},{}\n", name_name, latitude_name, longitude_name, altitude_name,
                          altitude_above_name, dwell_name, priority_name, sensor_quality_name);
  const auto number = [](const std::optional<double>& value) { return value ? decimal_text(*value) : ""; };
  for (const auto& point : points) {
    const auto altitude = point.altitude ? number(point.altitude->height.value) : "";
    const auto above = point.altitude ? name_of(point.altitude->above) : "";
    const auto dwell = point.dwell.count() > 0 ? number(point.dwell.count()) : "";
    text += fmt::format("{},{},{},{},{},{},{},{}\n", csv_cell(point.name),
                        number(degrees_from_radians(point.place.latitude)),
                        number(degrees_from_radians(point.place.longitude)), altitude, above, dwell,
                        number(point.priority), number(point.sensor_quality));
  }
  return {bytes_from(text), std::move(losses)};
}

}  // namespace ponte::planning
