#pragma once

#include "ponte/planning/formats/mission_file.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

/// Reading a point attribute by attribute. CSV, GeoJSON and KML use the same names, which the writers write too.
/// These functions throw `FormatError`, and the readers that call them return it.
namespace ponte::planning {

inline constexpr std::string_view altitude_name = "altitude";              ///< in metres
inline constexpr std::string_view altitude_above_name = "altitude_above";  ///< "msl", "home" or "terrain"
inline constexpr std::string_view dwell_name = "dwell_s";
inline constexpr std::string_view priority_name = "priority";
inline constexpr std::string_view sensor_quality_name = "sensor_quality";
inline constexpr std::string_view name_name = "name";

inline constexpr std::array altitude_frames{vehicle::AltitudeFrame::msl, vehicle::AltitudeFrame::home,
                                            vehicle::AltitudeFrame::terrain};
[[nodiscard]] std::string_view name_of(vehicle::AltitudeFrame frame);

class PointDraft {
 public:
  explicit PointDraft(Where where) { point_.where = where; }

  void set_place(vehicle::Place place) { point_.place = place; }
  void set_altitude(double metres) { altitude_ = metres; }
  /// The attribute called `name`. False when no attribute is called so.
  /// True when an attribute is called so.
  [[nodiscard]] static bool knows(std::string_view name);
  /// Sets the attribute of this name, which `knows` knows.
  void set(std::string_view name, std::string_view value);

  /// The point. Its altitude counts from what the file tells, or else from `untold`, without which it is refused.
  [[nodiscard]] PointOfInterest finish(std::optional<vehicle::AltitudeFrame> untold) const;
  /// True when it has an altitude, and the file does not tell above what.
  [[nodiscard]] bool altitude_is_vague() const { return altitude_ && !above_; }

 private:
  [[nodiscard]] double number(std::string_view name, std::string_view value, double highest) const;

  PointOfInterest point_;
  std::optional<double> altitude_;
  std::optional<vehicle::AltitudeFrame> above_;
};

}  // namespace ponte::planning
