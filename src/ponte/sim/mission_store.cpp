#include "ponte/sim/mission_store.hpp"

#include "ponte/core/assert.hpp"

namespace ponte::sim {
namespace {

/// Of missions, fences and rally points: what the recorded autopilots are built with.
constexpr std::array<std::size_t, plan_types> capacities(Personality personality) {
  if (personality == Personality::ardupilot) return {650, 250, 50};
  return {500, 64, 32};
}

}  // namespace

MissionStore::MissionStore(Personality personality, std::optional<std::size_t> mission_capacity) {
  auto limits = capacities(personality);
  limits[0] = mission_capacity.value_or(limits[0]);
  for (std::size_t i = 0; i < plan_types; ++i) {
    plans_[i].capacity = limits[i];
    plans_[i].items.reserve(limits[i]);
  }
}

void MissionStore::replace(PlanType type, std::span<const Item> items) {
  auto& changed = plan(type);
  PONTE_ASSERT(items.size() <= changed.capacity);
  changed.items.assign(items.begin(), items.end());
  ++changed.changes;
}

void MissionStore::put(PlanType type, std::size_t index, const Item& item) {
  auto& changed = plan(type);
  PONTE_ASSERT(index < changed.capacity && index <= changed.items.size());
  if (index == changed.items.size())
    changed.items.push_back(item);
  else
    changed.items[index] = item;
  ++changed.changes;
}

void MissionStore::truncate(PlanType type, std::size_t count) {
  auto& changed = plan(type);
  if (count >= changed.items.size()) return;
  changed.items.resize(count);
  ++changed.changes;
}

}  // namespace ponte::sim
