#include "ponte/autopilot/v09.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/v09/enums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace ponte::autopilot::v09 {
namespace {

namespace now = mavlink::autopilots;
using namespace mavlink::v09;
using vehicle::Mode;
using vehicle::ModeKind;

struct NumberRow {
  std::uint8_t then;
  std::uint8_t now;
};

/// What the rows say; a number without one has not changed.
template <std::size_t Size>
std::uint8_t renumbered(const std::array<NumberRow, Size>& rows, std::uint8_t number) {
  const auto found = std::ranges::find(rows, number, &NumberRow::then);
  return found == rows.end() ? number : found->now;
}

constexpr std::array autopilots{NumberRow{MAV_AUTOPILOT_NONE, now::MAV_AUTOPILOT_INVALID}};
constexpr std::array airframes{NumberRow{MAV_GROUND, now::MAV_TYPE_GENERIC}, NumberRow{OCU, now::MAV_TYPE_GCS}};
constexpr std::array states{NumberRow{MAV_STATE_HILSIM, now::MAV_STATE_ACTIVE},
                            NumberRow{MAV_STATE_POWEROFF, now::MAV_STATE_POWEROFF}};

struct ModeRow {
  std::uint8_t number;
  ModeKind kind;
  std::string_view name;
};

// clang-format off
constexpr std::array modes{
    ModeRow{MAV_MODE_UNINIT,      ModeKind::none,    "UNINIT"},
    ModeRow{MAV_MODE_LOCKED,      ModeKind::none,    "LOCKED"},
    ModeRow{MAV_MODE_MANUAL,      ModeKind::manual,  "MANUAL"},
    ModeRow{MAV_MODE_GUIDED,      ModeKind::guided,  "GUIDED"},
    ModeRow{MAV_MODE_AUTO,        ModeKind::mission, "AUTO"},
    ModeRow{MAV_MODE_TEST1,       ModeKind::other,   "TEST1"},
    ModeRow{MAV_MODE_TEST2,       ModeKind::other,   "TEST2"},
    ModeRow{MAV_MODE_TEST3,       ModeKind::other,   "TEST3"},
    ModeRow{MAV_MODE_READY,       ModeKind::none,    "READY"},
    ModeRow{MAV_MODE_RC_TRAINING, ModeKind::none,    "RC_TRAINING"},
};
/// Under automatic control.
constexpr std::array navigation_modes{
    ModeRow{MAV_NAV_LIFTOFF,   ModeKind::take_off,    "AUTO.LIFTOFF"},
    ModeRow{MAV_NAV_HOLD,      ModeKind::hold,        "AUTO.HOLD"},
    ModeRow{MAV_NAV_LOITER,    ModeKind::hold,        "AUTO.LOITER"},
    ModeRow{MAV_NAV_RETURNING, ModeKind::return_home, "AUTO.RETURNING"},
    ModeRow{MAV_NAV_LANDING,   ModeKind::land,        "AUTO.LANDING"},
};
// clang-format on

}  // namespace

std::uint8_t autopilot_of(std::uint8_t autopilot) { return renumbered(autopilots, autopilot); }

std::uint8_t airframe_of(std::uint8_t type) { return renumbered(airframes, type); }

std::uint8_t system_status_of(std::uint8_t status) { return renumbered(states, status); }

bool is_armed(std::uint8_t mode, std::uint8_t status) {
  const bool is_blocked = mode == MAV_MODE_UNINIT || mode == MAV_MODE_LOCKED || mode == MAV_MODE_RC_TRAINING;
  const bool is_active = status >= MAV_STATE_ACTIVE && status <= MAV_STATE_HILSIM;
  return !is_blocked && is_active;
}

std::optional<std::uint8_t> landed_state_of(std::uint8_t nav_mode) {
  switch (nav_mode) {
    case MAV_NAV_GROUNDED: return now::MAV_LANDED_STATE_ON_GROUND;
    case MAV_NAV_LIFTOFF: return now::MAV_LANDED_STATE_TAKEOFF;
    case MAV_NAV_LANDING: return now::MAV_LANDED_STATE_LANDING;
    case MAV_NAV_HOLD:
    case MAV_NAV_WAYPOINT:
    case MAV_NAV_VECTOR:
    case MAV_NAV_RETURNING:
    case MAV_NAV_LOITER: return now::MAV_LANDED_STATE_IN_AIR;
    default: return std::nullopt;
  }
}

std::uint8_t severity_of(std::uint8_t severity) {
  if (severity == 255) return now::MAV_SEVERITY_CRITICAL;
  return severity >= 128 ? now::MAV_SEVERITY_WARNING : now::MAV_SEVERITY_INFO;
}

Mode mode_of(std::uint8_t mode, std::uint8_t nav_mode) {
  if (mode == MAV_MODE_AUTO) {
    const auto row = std::ranges::find(navigation_modes, nav_mode, &ModeRow::number);
    if (row != navigation_modes.end()) return {.kind = row->kind, .variant = 0, .name = row->name};
  }
  Mode result{.kind = ModeKind::other, .variant = static_cast<std::uint8_t>(mode & 0x7FU), .name = {}};
  const auto row = std::ranges::find(modes, mode, &ModeRow::number);
  if (row == modes.end()) {
    fmt::format_to_n(result.name.chars().data(), result.name.chars().size() - 1, "mode {}", mode);
    return result;
  }
  result.kind = row->kind;
  result.name = row->name;
  if (result.kind != ModeKind::other) result.variant = 0;
  return result;
}

}  // namespace ponte::autopilot::v09
