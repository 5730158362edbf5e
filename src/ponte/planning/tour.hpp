#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace ponte::planning {

/// A round trip through cities 0 to n - 1 in an array. Knows no costs.
class Tour {
 public:
  using City = std::uint32_t;

  /// Through the cities in this order.
  explicit Tour(std::vector<City> order) : order_{std::move(order)}, position_(order_.size()) {
    for (City at = 0; at < size(); ++at) position_[order_[at]] = at;
  }

  [[nodiscard]] City size() const { return static_cast<City>(order_.size()); }
  [[nodiscard]] City next(City city) const { return is_reversed_ ? before(city) : after(city); }
  [[nodiscard]] City previous(City city) const { return is_reversed_ ? after(city) : before(city); }

  /// The city so many steps further on, at most `size()`.
  [[nodiscard]] City ahead(City city, City steps) const {
    const auto at = position_[city] + (is_reversed_ ? size() - steps : steps);
    return order_[at >= size() ? at - size() : at];
  }

  /// Now it goes the other way round.
  void mirror() { is_reversed_ = !is_reversed_; }

  /// Turns the part from `first` to `last` round: what led to `first` leads to `last` then. It moves at most half of
  /// the cities, for the rest may be turned round instead.
  void reverse(City first, City last) {
    Turn turn{position_[is_reversed_ ? last : first], position_[is_reversed_ ? first : last], false};
    const auto count = (turn.from <= turn.to ? turn.to - turn.from : turn.to + size() - turn.from) + 1;
    if (2 * count > size()) turn = {at_or_first(turn.to + 1), turn.from == 0 ? size() - 1 : turn.from - 1, true};
    apply(turn);
    turns_.push_back(turn);
  }

  /// How often `reverse` was called since the last `keep`.
  [[nodiscard]] std::size_t turns() const { return turns_.size(); }
  /// Takes the last `reverse` back.
  void take_back() {
    apply(turns_.back());
    turns_.pop_back();
  }
  void keep() { turns_.clear(); }

 private:
  struct Turn {
    City from{};
    City to{};
    bool turns_the_rest{};
  };
  void apply(const Turn& turn) {
    if (turn.turns_the_rest) is_reversed_ = !is_reversed_;
    const auto count = (turn.from <= turn.to ? turn.to - turn.from : turn.to + size() - turn.from) + 1;
    auto from = turn.from;
    auto to = turn.to;
    // A count of all cities is that of an empty rest.
    for (auto swaps = count % size() / 2; swaps > 0; --swaps) {
      std::swap(order_[from], order_[to]);
      position_[order_[from]] = from;
      position_[order_[to]] = to;
      from = at_or_first(from + 1);
      to = to == 0 ? size() - 1 : to - 1;
    }
  }
  [[nodiscard]] City at_or_first(City at) const { return at == size() ? 0 : at; }
  [[nodiscard]] City after(City city) const {
    const auto at = position_[city] + 1;
    return order_[at_or_first(at)];
  }
  [[nodiscard]] City before(City city) const {
    const auto at = position_[city];
    return order_[at == 0 ? size() - 1 : at - 1];
  }

  std::vector<City> order_;
  std::vector<City> position_;
  bool is_reversed_{};
  std::vector<Turn> turns_;
};

}  // namespace ponte::planning
