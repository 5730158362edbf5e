#pragma once

#include "ponte/planning/formats/mission_file.hpp"

#include <span>
#include <vector>

/// What every format asks of the places that it reads.
namespace ponte::planning {

/// The place at these degrees. Throws `FormatError` for what is no place on Earth, and says when the two numbers look
/// swapped.
[[nodiscard]] vehicle::Place checked_place(double latitude, double longitude, Where where);

/// "47.397742, 8.545594": degrees, latitude first.
[[nodiscard]] std::string to_text(const vehicle::Place& place);

struct PlaceInFile {
  vehicle::Place place;
  Where where;
};

/// Remarks on places that can be meant, but hardly are: the same place twice, 0, 0, and places far from the middle of
/// all, which often are swapped numbers.
[[nodiscard]] std::vector<Remark> doubts(std::span<const PlaceInFile> places);

/// The same of points.
[[nodiscard]] std::vector<Remark> doubts(std::span<const PointOfInterest> points);

}  // namespace ponte::planning
