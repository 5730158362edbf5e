#pragma once

#include <compare>

namespace ponte {

/// A number that names something. Ids of different tags never compare, convert or add.
template <class Tag, class Rep>
struct Id {
  using rep = Rep;
  Rep value{};

  constexpr Id() = default;
  constexpr explicit Id(Rep number) : value{number} {}
  friend constexpr auto operator<=>(const Id&, const Id&) = default;
};

}  // namespace ponte
