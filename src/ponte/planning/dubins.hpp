#pragma once

#include "ponte/planning/geodesy.hpp"

#include <array>
#include <cstdint>
#include <optional>

/// The shortest ways of a vehicle that cannot turn on the spot: L. E. Dubins, "On curves of minimal length with a
/// constraint on average curvature, and with prescribed initial and terminal positions and tangents", American Journal
/// of Mathematics 79(3), 1957.
namespace ponte::planning {

struct Pose {
  MapPoint at{};
  Radians course{};
};

/// Which way the three pieces of a path bend: L left, R right, S straight.
enum class DubinsWord : std::uint8_t { lsl, lsr, lrl, rsr, rsl, rlr };
inline constexpr std::array dubins_words{DubinsWord::lsl, DubinsWord::lsr, DubinsWord::lrl,
                                         DubinsWord::rsr, DubinsWord::rsl, DubinsWord::rlr};

struct DubinsPath {
  struct Piece {
    int bend{};       ///< 1 to the right, -1 to the left, 0 straight
    double metres{};  ///< along it
  };
  Pose start{};
  double radius{};  ///< metres, above 0
  std::array<Piece, 3> pieces{};

  [[nodiscard]] double length() const { return pieces[0].metres + pieces[1].metres + pieces[2].metres; }
  /// Its first so many metres, 0 to `length`.
  [[nodiscard]] DubinsPath first(double metres) const;
  /// After so many.
  [[nodiscard]] Pose pose_after(double metres) const;
};

/// The path of this word; nothing where the circles of both ends lie so that there is none. Of the two that lrl and rlr
/// can have it is the shorter one.
[[nodiscard]] std::optional<DubinsPath> dubins_path(DubinsWord word, const Pose& from, const Pose& to, double radius);

/// The shortest of all words; lsl and rsr always exist.
[[nodiscard]] DubinsPath shortest_dubins_path(const Pose& from, const Pose& to, double radius);

}  // namespace ponte::planning
