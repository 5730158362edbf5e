#include "ponte/vehicle/mission.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::vehicle {

bool operator==(const OtherItem& a, const OtherItem& b) {
  const auto same = [](double left, double right) { return left == right || (std::isnan(left) && std::isnan(right)); };
  return a.command == b.command && a.frame == b.frame && std::ranges::equal(a.parameters, b.parameters, same);
}

std::optional<Place> place_of(const Action& action) {
  return std::visit(
      []<class Item>(const Item& item) -> std::optional<Place> {
        if constexpr (requires { item.place; })
          return item.place;
        else
          return std::nullopt;
      },
      action);
}

}  // namespace ponte::vehicle
