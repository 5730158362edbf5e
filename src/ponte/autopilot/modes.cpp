#include "ponte/autopilot/modes.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace ponte::autopilot {
namespace {

using enum vehicle::ModeKind;
using vehicle::ModeKind;

// clang-format off
constexpr std::array copter_modes{
    ModeRow{0,  "STABILIZE",    manual},
    ModeRow{1,  "ACRO",         manual},
    ModeRow{2,  "ALT_HOLD",     manual},
    ModeRow{3,  "AUTO",         mission},
    ModeRow{4,  "GUIDED",       guided},
    ModeRow{5,  "LOITER",       hold},
    ModeRow{6,  "RTL",          return_home},
    ModeRow{7,  "CIRCLE",       hold},
    ModeRow{9,  "LAND",         land},
    ModeRow{11, "DRIFT",        other},
    ModeRow{13, "SPORT",        manual},
    ModeRow{14, "FLIP",         other},
    ModeRow{15, "AUTOTUNE",     other},
    ModeRow{16, "POSHOLD",      hold},
    ModeRow{17, "BRAKE",        hold},
    ModeRow{18, "THROW",        other},
    ModeRow{19, "AVOID_ADSB",   other},
    ModeRow{20, "GUIDED_NOGPS", other},
    ModeRow{21, "SMART_RTL",    smart_return},
    ModeRow{22, "FLOWHOLD",     other},
    ModeRow{23, "FOLLOW",       other},
    ModeRow{24, "ZIGZAG",       other},
    ModeRow{25, "SYSTEMID",     other},
    ModeRow{26, "AUTOROTATE",   other},
    ModeRow{27, "AUTO_RTL",     other},
    ModeRow{28, "TURTLE",       other},
};

constexpr std::array plane_modes{
    ModeRow{0,  "MANUAL",           manual},
    ModeRow{1,  "CIRCLE",           hold},
    ModeRow{2,  "STABILIZE",        manual},
    ModeRow{3,  "TRAINING",         other},
    ModeRow{4,  "ACRO",             other},
    ModeRow{5,  "FBWA",             manual},
    ModeRow{6,  "FBWB",             manual},
    ModeRow{7,  "CRUISE",           guided},
    ModeRow{8,  "AUTOTUNE",         other},
    ModeRow{10, "AUTO",             mission},
    ModeRow{11, "RTL",              return_home},
    ModeRow{12, "LOITER",           hold},
    ModeRow{13, "TAKEOFF",          take_off},
    ModeRow{14, "AVOID_ADSB",       other},
    ModeRow{15, "GUIDED",           guided},
    ModeRow{16, "INITIALISING",     none},
    ModeRow{17, "QSTABILIZE",       other},
    ModeRow{18, "QHOVER",           other},
    ModeRow{19, "QLOITER",          hold},
    ModeRow{20, "QLAND",            land},
    ModeRow{21, "QRTL",             vtol_return},
    ModeRow{22, "QAUTOTUNE",        other},
    ModeRow{23, "QACRO",            other},
    ModeRow{24, "THERMAL",          other},
    ModeRow{25, "LOITER_ALT_QLAND", other},
    ModeRow{26, "AUTOLAND",         land},
};

constexpr std::uint32_t px4(std::uint32_t main, std::uint32_t sub = 0) { return main << 16U | sub << 24U; }
constexpr std::uint32_t px4_auto = 4;

constexpr auto px4_modes = [] {
  std::array rows{
      ModeRow{px4(1),      "MANUAL",               manual},
      ModeRow{px4(2),      "ALTCTL",               manual},
      ModeRow{px4(3),      "POSCTL",               manual},
      ModeRow{px4(3, 1),   "POSCTL.ORBIT",         hold},
      ModeRow{px4(3, 2),   "POSCTL.SLOW",          manual},
      ModeRow{px4(4, 1),   "AUTO.READY",           other},
      ModeRow{px4(4, 2),   "AUTO.TAKEOFF",         take_off},
      ModeRow{px4(4, 3),   "AUTO.LOITER",          hold},
      ModeRow{px4(4, 4),   "AUTO.MISSION",         mission},
      ModeRow{px4(4, 5),   "AUTO.RTL",             return_home},
      ModeRow{px4(4, 6),   "AUTO.LAND",            land},
      ModeRow{px4(4, 8),   "AUTO.FOLLOW_TARGET",   guided},
      ModeRow{px4(4, 9),   "AUTO.PRECLAND",        other},
      ModeRow{px4(4, 10),  "AUTO.VTOL_TAKEOFF",    other},
      ModeRow{px4(4, 11),  "AUTO.EXTERNAL1",       other},
      ModeRow{px4(4, 12),  "AUTO.EXTERNAL2",       other},
      ModeRow{px4(4, 13),  "AUTO.EXTERNAL3",       other},
      ModeRow{px4(4, 14),  "AUTO.EXTERNAL4",       other},
      ModeRow{px4(4, 15),  "AUTO.EXTERNAL5",       other},
      ModeRow{px4(4, 16),  "AUTO.EXTERNAL6",       other},
      ModeRow{px4(4, 17),  "AUTO.EXTERNAL7",       other},
      ModeRow{px4(4, 18),  "AUTO.EXTERNAL8",       other},
      ModeRow{px4(4, 19),  "AUTO.GUIDED_COURSE",   other},
      ModeRow{px4(5),      "ACRO",                 manual},
      ModeRow{px4(6),      "OFFBOARD",             guided},
      ModeRow{px4(7),      "STABILIZED",           manual},
      ModeRow{px4(8),      "RATTITUDE",            other},
      ModeRow{px4(9),      "SIMPLE",               other},
      ModeRow{px4(10),     "TERMINATION",          other},
      ModeRow{px4(11),     "ALTITUDE_CRUISE",      other},
  };
  std::ranges::sort(rows, {}, &ModeRow::custom_mode);
  return rows;
}();
// clang-format on

/// Modes of kind `other` keep apart by this number.
std::uint8_t variant_of(Stack stack, std::uint32_t custom_mode) {
  if (stack != Stack::px4) return static_cast<std::uint8_t>(custom_mode & 0x7FU);
  constexpr std::uint32_t first_auto_variant = 32;
  const auto main = custom_mode >> 16U & 0xFFU;
  const auto sub = custom_mode >> 24U & 0x3FU;
  return static_cast<std::uint8_t>(main == px4_auto ? first_auto_variant + sub : main & 0x1FU);
}

}  // namespace

Stack stack_of(std::uint8_t autopilot, std::uint8_t airframe) {
  using namespace mavlink::autopilots;
  constexpr std::array<std::uint8_t, 8> copters{MAV_TYPE_QUADROTOR,   MAV_TYPE_COAXIAL,   MAV_TYPE_HELICOPTER,
                                                MAV_TYPE_HEXAROTOR,   MAV_TYPE_OCTOROTOR, MAV_TYPE_TRICOPTER,
                                                MAV_TYPE_DODECAROTOR, MAV_TYPE_DECAROTOR};
  if (autopilot == MAV_AUTOPILOT_PX4) return Stack::px4;
  if (autopilot != MAV_AUTOPILOT_ARDUPILOTMEGA) return Stack::unknown;
  if (std::ranges::find(copters, airframe) != copters.end()) return Stack::ardupilot_copter;
  constexpr std::uint8_t first_vtol = 19;
  constexpr std::uint8_t last_vtol = 25;
  const bool is_vtol = airframe >= first_vtol && airframe <= last_vtol;
  return airframe == MAV_TYPE_FIXED_WING || is_vtol ? Stack::ardupilot_plane : Stack::unknown;
}

std::span<const ModeRow> modes_of(Stack stack) {
  switch (stack) {
    case Stack::ardupilot_copter: return copter_modes;
    case Stack::ardupilot_plane: return plane_modes;
    case Stack::px4: return px4_modes;
    case Stack::unknown: return {};
  }
  return {};
}

std::optional<std::uint32_t> custom_mode_named(Stack stack, std::string_view name) {
  const auto rows = modes_of(stack);
  const auto found = std::ranges::find(rows, name, &ModeRow::name);
  if (found == rows.end()) return std::nullopt;
  return found->custom_mode;
}

std::optional<std::uint32_t> custom_mode_for(Stack stack, vehicle::ModeKind kind) {
  if (kind == none || kind == other) return std::nullopt;
  // Where the first one of its kind is not the one that is meant.
  if (stack == Stack::ardupilot_plane && kind == hold) return custom_mode_named(stack, "LOITER");
  if (stack == Stack::ardupilot_plane && kind == guided) return custom_mode_named(stack, "GUIDED");
  if (stack == Stack::ardupilot_plane && kind == land) return custom_mode_named(stack, "AUTOLAND");
  if (stack == Stack::px4 && kind == hold) return custom_mode_named(stack, "AUTO.LOITER");
  const auto rows = modes_of(stack);
  const auto found = std::ranges::find(rows, kind, &ModeRow::kind);
  if (found == rows.end()) return std::nullopt;
  return found->custom_mode;
}

vehicle::Mode mode_from(Stack stack, std::uint32_t custom_mode) {
  vehicle::Mode mode{.kind = other, .variant = variant_of(stack, custom_mode), .name = {}};
  const auto rows = modes_of(stack);
  const auto found = std::ranges::lower_bound(rows, custom_mode, {}, &ModeRow::custom_mode);
  if (found != rows.end() && found->custom_mode == custom_mode) {
    mode.kind = found->kind;
    mode.name = found->name;
    if (mode.kind != other) mode.variant = 0;
    return mode;
  }
  fmt::format_to_n(mode.name.chars().data(), mode.name.chars().size() - 1, "mode {}", custom_mode);
  return mode;
}

}  // namespace ponte::autopilot
