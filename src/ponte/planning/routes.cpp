#include "ponte/planning/routes.hpp"

namespace ponte::planning {

Routes::Routes(const Legs& legs) : legs_{legs}, places_(legs.stops() + legs.vehicles()), routes_(legs.vehicles()) {
  for (Node stop = 0; stop < legs.stops(); ++stop) unvisited_priority_ += legs.priority(stop);
  for (Node vehicle = 0; vehicle < legs.vehicles(); ++vehicle) {
    const auto home = legs.home(vehicle);
    places_[home] = {home, home, vehicle};
  }
  keep();
}

void Routes::insert(Node vehicle, Node node, Node stop) {
  auto& route = routes_[vehicle];
  route.cost += added_cost(vehicle, node, stop);
  ++route.size;
  unvisited_priority_ -= legs_.priority(stop);
  const auto after = next(node);
  changed(stop) = {node, after, vehicle};
  changed(node).next = stop;
  changed(after).previous = stop;
}

void Routes::remove(Node stop) {
  const auto [before, after, vehicle] = places_[stop];
  changed(stop).vehicle = nobody;
  changed(before).next = after;
  changed(after).previous = before;
  auto& route = routes_[vehicle];
  route.cost -= added_cost(vehicle, before, stop);
  --route.size;
  unvisited_priority_ += legs_.priority(stop);
}

void Routes::keep() {
  changes_.clear();
  kept_routes_ = routes_;
  kept_priority_ = unvisited_priority_;
}

void Routes::take_back() {
  for (; !changes_.empty(); changes_.pop_back()) places_[changes_.back().node] = changes_.back().before;
  routes_ = kept_routes_;
  unvisited_priority_ = kept_priority_;
}

bool Routes::are_within_limits() const {
  for (Node vehicle = 0; vehicle < legs_.vehicles(); ++vehicle)
    if (cost(vehicle) > legs_.limit(vehicle)) return false;
  return true;
}

Plan Routes::plan() const {
  Plan result;
  for (Node vehicle = 0; vehicle < legs_.vehicles(); ++vehicle) {
    auto& route = result.routes.emplace_back();
    for (auto node = next(legs_.home(vehicle)); node != legs_.home(vehicle); node = next(node)) route.push_back(node);
  }
  return result;
}

}  // namespace ponte::planning
