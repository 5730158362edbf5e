#pragma once

#include "ponte/planning/legs.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace ponte::planning {

/// The nearest nodes of each node, the nearest first.
class Neighbours {
 public:
  /// The `count` nearest of nodes 0 to `nodes` - 1, or all when there are fewer, by `distance(a, b)` in ticks.
  template <class Distance>
  Neighbours(Node nodes, Node count, const Distance& distance) : count_{std::min(count, nodes > 0 ? nodes - 1 : 0)} {
    std::vector<std::pair<Ticks, Node>> others;
    for (Node node = 0; node < nodes; ++node) {
      others.clear();
      for (Node other = 0; other < nodes; ++other)
        if (other != node) others.emplace_back(distance(node, other), other);
      std::ranges::partial_sort(others, others.begin() + count_);
      for (Node i = 0; i < count_; ++i) nearest_.push_back(others[i].second);
    }
  }

  [[nodiscard]] std::span<const Node> of(Node node) const {
    return std::span{nearest_}.subspan(std::size_t{node} * count_, count_);
  }

 private:
  Node count_;
  std::vector<Node> nearest_;
};

}  // namespace ponte::planning
