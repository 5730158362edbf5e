#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/planning/point_of_interest.hpp"
#include "ponte/planning/where.hpp"
#include "ponte/vehicle/mission.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Files of points of interest and of missions: bytes in and bytes out, no file is opened here.
namespace ponte::planning {

/// What any of the formats can hold. Formats of missions fill `mission.items`, the others `points`; zones are in
/// `mission` whichever it was.
struct MissionFile {
  std::vector<PointOfInterest> points{};
  vehicle::Mission mission{};
  friend bool operator==(const MissionFile&, const MissionFile&) = default;
};

/// How the values of a `path.poi` are written.
enum class PoiLayout : std::uint8_t { f64_le, f64_be, f32_le, f32_be };

/// What the user tells of a file that does not tell it itself.
struct ReadOptions {
  std::optional<PoiLayout> poi_layout{};
  std::optional<vehicle::AltitudeFrame> altitude_above{};  ///< what altitudes are counted from
  /// A polygon that does not tell whether it is a fence is an inclusion; else it is not kept, and a remark says so.
  bool bare_polygons_are_inclusions{};
};

/// Something that a reader did not keep, or took although it looks wrong: a whole clause.
struct Remark {
  Where where{};
  std::string text{};
  friend bool operator==(const Remark&, const Remark&) = default;
};

struct Reading {
  MissionFile content{};
  std::vector<Remark> remarks{};
};

/// Why a file cannot be read, for a message such as "line 7: latitude is 91: expected -90 to 90".
struct FormatError {
  Where where{};
  std::string what{};         ///< e.g. "latitude is 91"
  std::string expectation{};  ///< completes "expected ..."
  friend bool operator==(const FormatError&, const FormatError&) = default;
};

using ReadingResult = Result<Reading, FormatError>;

/// What a writer made, and what of the content its format cannot say, one clause each.
struct Writing {
  std::vector<std::byte> bytes{};
  std::vector<std::string> losses{};
};

}  // namespace ponte::planning
