#include "ponte/planning/formats/format.hpp"

#include "ponte/core/utf8.hpp"
#include "ponte/planning/formats/csv.hpp"
#include "ponte/planning/formats/geojson.hpp"
#include "ponte/planning/formats/gpx.hpp"
#include "ponte/planning/formats/kml.hpp"
#include "ponte/planning/formats/plan.hpp"
#include "ponte/planning/formats/poi.hpp"
#include "ponte/planning/formats/text.hpp"
#include "ponte/planning/formats/wpl.hpp"

#include <algorithm>

namespace ponte::planning {
namespace {

struct NameEnd {
  std::string_view end;
  Format format;
};
/// WPL is also written to .txt, which says nothing.
constexpr NameEnd name_ends[]{{".poi", Format::poi},         {".csv", Format::csv},      {".tsv", Format::csv},
                              {".geojson", Format::geojson}, {".json", Format::geojson}, {".kml", Format::kml},
                              {".kmz", Format::kmz},         {".gpx", Format::gpx},      {".plan", Format::plan},
                              {".waypoints", Format::wpl},   {".wpl", Format::wpl}};

bool contains(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

/// Text has no control characters and is UTF-8; doubles nearly always have one or are none.
bool is_text(std::string_view text) {
  while (!text.empty()) {
    const bool is_control = text.front() >= 0 && text.front() < 0x20 && !contains("\t\r\n", text.substr(0, 1));
    const auto length = utf8_length(text);
    if (is_control || length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

/// A word that only one of the formats can have so near its beginning; nothing where it has none or several.
std::optional<Format> format_of_text(std::string_view text) {
  constexpr std::size_t telling = 4096;
  const auto beginning = trimmed(text.substr(0, telling));
  if (beginning.starts_with("QGC WPL")) return Format::wpl;
  if (beginning.starts_with('{')) {
    // The members of a JSON object have no order, so that the word may be anywhere.
    const bool is_plan = contains(text, "\"fileType\"") && contains(text, "\"Plan\"");
    const bool is_geojson = contains(text, "\"coordinates\"") || contains(text, "\"FeatureCollection\"");
    if (is_plan != is_geojson) return is_plan ? Format::plan : Format::geojson;
    return std::nullopt;
  }
  if (beginning.starts_with('<')) {
    const bool is_kml = contains(beginning, "<kml") || contains(beginning, ":kml");
    const bool is_gpx = contains(beginning, "<gpx") || contains(beginning, ":gpx");
    if (is_kml != is_gpx) return is_kml ? Format::kml : Format::gpx;
    return std::nullopt;
  }
  const auto header = lower_case(beginning.substr(0, beginning.find_first_of("\r\n")));
  if (contains(header, "lat") && header.find_first_of(",;\t") != header.npos) return Format::csv;
  return std::nullopt;
}

std::string_view without_mark(Bytes bytes) {
  std::string_view text{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return text;
}

}  // namespace

std::string_view name_of(Format format) {
  constexpr std::array<std::string_view, formats.size()> names{"poi", "csv", "geojson", "kml",
                                                               "kmz", "gpx", "plan",    "wpl"};
  return names[static_cast<std::size_t>(format)];
}

std::optional<Format> format_named(std::string_view name) {
  const auto found = std::ranges::find(formats, name, [](Format format) { return name_of(format); });
  return found == formats.end() ? std::nullopt : std::optional{*found};
}

std::vector<std::string> format_names() {
  std::vector<std::string> names;
  for (const auto format : formats) names.emplace_back(name_of(format));
  return names;
}

std::optional<Format> format_of_name(std::string_view file_name) {
  const auto name = lower_case(file_name);
  for (const auto& [end, format] : name_ends)
    if (name.ends_with(end)) return format;
  return std::nullopt;
}

Result<Format, FormatError> detect_format(Bytes bytes, std::string_view file_name) {
  if (bytes.empty()) return fail(FormatError{{}, "it is empty", "points or a mission"});
  const auto text = without_mark(bytes);
  if (text.starts_with("PK\x03\x04")) return Format::kmz;
  if (const auto format = format_of_text(text)) return *format;
  if (!is_text(text)) return Format::poi;
  if (const auto format = format_of_name(file_name)) return *format;
  return fail(
      FormatError{at_line(1), "neither the text nor the name of the file tells its format", "to be told it (--from)"});
}

ReadingResult read_mission_file(Format format, Bytes bytes, const ReadOptions& options) {
  switch (format) {
    case Format::poi: return read_poi(bytes, options);
    case Format::csv: return read_csv(bytes, options);
    case Format::geojson: return read_geojson(bytes, options);
    case Format::kml: return read_kml(bytes, options);
    case Format::kmz: return read_kmz(bytes, options);
    case Format::gpx: return read_gpx(bytes, options);
    case Format::plan: return read_plan(bytes, options);
    case Format::wpl: return read_wpl(bytes, options);
  }
  return Reading{};
}

Result<Writing, FormatError> write_mission_file(Format format, const MissionFile& content) {
  switch (format) {
    case Format::poi: return write_poi(content);
    case Format::csv: return write_csv(content);
    case Format::geojson: return write_geojson(content);
    case Format::kml: return write_kml(content);
    case Format::kmz: return write_kmz(content);
    case Format::gpx: return write_gpx(content);
    case Format::plan: return write_plan(content);
    case Format::wpl: return write_wpl(content);
  }
  return Writing{};
}

}  // namespace ponte::planning
