#include "ponte/autopilot/kept_plan.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

bool is_same_number(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// The deprecated names of the global frames say the same as the others.
std::uint8_t frame_of(const WireItem& item) {
  switch (item.frame) {
    case messages::MAV_FRAME_GLOBAL_INT: return messages::MAV_FRAME_GLOBAL;
    case messages::MAV_FRAME_GLOBAL_RELATIVE_ALT_INT: return messages::MAV_FRAME_GLOBAL_RELATIVE_ALT;
    case messages::MAV_FRAME_GLOBAL_TERRAIN_ALT_INT: return messages::MAV_FRAME_GLOBAL_TERRAIN_ALT;
    default: return item.frame;
  }
}

std::array<float, 4> parameters_of(const WireItem& item) {
  return {item.param1, item.param2, item.param3, item.param4};
}

bool is_same_place(const WireItem& a, const WireItem& b) { return a.command == b.command && a.x == b.x && a.y == b.y; }

bool is_same_item(const WireItem& a, const WireItem& b) {
  return is_same_place(a, b) && frame_of(a) == frame_of(b) && a.autocontinue == b.autocontinue &&
         std::ranges::equal(parameters_of(a), parameters_of(b), is_same_number) && is_same_number(a.z, b.z);
}

bool circles(std::uint16_t command) {
  return command == messages::MAV_CMD_NAV_LOITER_UNLIM || command == messages::MAV_CMD_NAV_LOITER_TURNS ||
         command == messages::MAV_CMD_NAV_LOITER_TIME || command == messages::MAV_CMD_NAV_LOITER_TO_ALT;
}

/// A parameter, from 0, as ArduPilot may have kept it.
bool ardupilot_keeps(std::uint16_t command, std::size_t parameter, float sent, float kept) {
  if (is_same_number(sent, kept) || (std::isnan(sent) && kept == 0)) return true;
  if (command > messages::MAV_CMD_NAV_LAST) return false;
  if (kept == 0 || kept == std::trunc(sent)) return true;
  if (command == messages::MAV_CMD_NAV_LAND && parameter == 3) return std::abs(kept) == 1;
  constexpr float largest_whole_radius = 255;
  constexpr float step = 10;
  return circles(command) && std::abs(sent) > largest_whole_radius && std::abs(sent - kept) < step;
}

bool ardupilot_keeps(const WireItem& sent, const WireItem& kept) {
  constexpr float centimetre = 0.01F;
  constexpr float of_a_float = 1e-6F;
  const auto before = parameters_of(sent);
  const auto after = parameters_of(kept);
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!ardupilot_keeps(sent.command, i, before[i], after[i])) return false;
  // What has no place has no frame either, and comes back with any.
  const bool has_place = sent.x != 0 || sent.y != 0;
  return is_same_place(sent, kept) && (!has_place || frame_of(sent) == frame_of(kept)) &&
         std::abs(sent.z - kept.z) <= centimetre + of_a_float * std::abs(sent.z);
}

}  // namespace

bool is_same_plan(std::span<const WireItem> a, std::span<const WireItem> b) {
  return std::ranges::equal(a, b, is_same_item);
}

std::optional<std::size_t> first_difference(Stack stack, PlanType type, std::span<const WireItem> sent,
                                            std::span<const WireItem> kept) {
  const auto first = home_items(stack, type);
  const auto both = std::min(sent.size(), kept.size());
  for (auto i = first; i < both; ++i)
    if (!(first != 0 ? ardupilot_keeps(sent[i], kept[i]) : is_same_item(sent[i], kept[i]))) return i;
  const auto is_empty = [first](std::span<const WireItem> plan) { return plan.size() <= first; };
  if (sent.size() == kept.size() || (is_empty(sent) && is_empty(kept))) return std::nullopt;
  return both;
}

}  // namespace ponte::autopilot
