#pragma once

#include "ponte/planning/legs.hpp"

namespace ponte::planning {

/// The routes of all vehicles while a solver works on them: rings of stops that begin and end at a vehicle's home. Each
/// change takes the same short time, and all changes since the last `keep` can be taken back.
class Routes {
 public:
  explicit Routes(const Legs& legs);

  static constexpr Node nobody = ~Node{0};

  /// The vehicle that visits this stop, or nobody.
  [[nodiscard]] Node vehicle_of(Node stop) const { return places_[stop].vehicle; }
  [[nodiscard]] Node next(Node node) const { return places_[node].next; }
  [[nodiscard]] Node previous(Node node) const { return places_[node].previous; }
  [[nodiscard]] Node size(Node vehicle) const { return routes_[vehicle].size; }
  [[nodiscard]] Ticks cost(Node vehicle) const { return routes_[vehicle].cost; }
  /// Of all stops that nobody visits.
  [[nodiscard]] Ticks unvisited_priority() const { return unvisited_priority_; }

  /// Whether no route costs more than its vehicle can. Even removing a stop can make a route costlier, where the way
  /// past it is closed.
  [[nodiscard]] bool are_within_limits() const;

  /// What the route of the vehicle would cost more with `stop`, which nobody visits, behind `node`.
  [[nodiscard]] Ticks added_cost(Node vehicle, Node node, Node stop) const {
    const auto after = next(node);
    return legs_(vehicle, node, stop) + legs_(vehicle, stop, after) - legs_(vehicle, node, after);
  }

  void insert(Node vehicle, Node node, Node stop);
  void remove(Node stop);

  /// From here on changes are remembered.
  void keep();
  /// Back to how it was at the last `keep`.
  void take_back();

  [[nodiscard]] Plan plan() const;

 private:
  struct Place {
    Node previous{};
    Node next{};
    Node vehicle{nobody};
  };
  struct Route {
    Ticks cost{};
    Node size{};
  };
  struct Change {
    Node node{};
    Place before;
  };
  Place& changed(Node node) {
    changes_.push_back({node, places_[node]});
    return places_[node];
  }

  const Legs& legs_;
  std::vector<Place> places_;
  std::vector<Route> routes_;
  Ticks unvisited_priority_{};

  std::vector<Change> changes_;
  std::vector<Route> kept_routes_;
  Ticks kept_priority_{};
};

}  // namespace ponte::planning
