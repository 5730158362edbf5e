#include "ponte/autopilot/stream_requests.hpp"

#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/autopilot_version.hpp"
#include "ponte/mavlink/autopilots/battery_status.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/gps_raw_int.hpp"
#include "ponte/mavlink/autopilots/highres_imu.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/mavlink/autopilots/nav_controller_output.hpp"
#include "ponte/mavlink/autopilots/scaled_imu.hpp"
#include "ponte/mavlink/autopilots/scaled_pressure.hpp"
#include "ponte/mavlink/autopilots/sys_status.hpp"
#include "ponte/mavlink/autopilots/system_time.hpp"
#include "ponte/mavlink/autopilots/vfr_hud.hpp"
#include "ponte/mavlink/autopilots/wind_cov.hpp"

#include <array>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

template <mavlink::Message M>
constexpr mavlink::MessageId id = M::info.id;

// clang-format off
constexpr std::array ardupilot_groups{
    StreamGroup{messages::MAV_DATA_STREAM_EXTRA1, 10},          // ATTITUDE, AOA_SSA
    StreamGroup{messages::MAV_DATA_STREAM_POSITION, 5},         // GLOBAL_POSITION_INT
    StreamGroup{messages::MAV_DATA_STREAM_EXTRA2, 4},           // VFR_HUD
    StreamGroup{messages::MAV_DATA_STREAM_EXTENDED_STATUS, 2},  // SYS_STATUS, GPS_RAW_INT, MISSION_CURRENT, NAV_CONTROLLER_OUTPUT
    StreamGroup{messages::MAV_DATA_STREAM_EXTRA3, 2},           // WIND, SYSTEM_TIME, BATTERY_STATUS, TERRAIN_REPORT, DISTANCE_SENSOR
    StreamGroup{messages::MAV_DATA_STREAM_RAW_SENSORS, 2},      // SCALED_PRESSURE
};
constexpr std::array ardupilot_rates{
    MessageRate{id<messages::ScaledImu>, 10},
    MessageRate{id<messages::ExtendedSysState>, 2},
    MessageRate{id<messages::HomePosition>, 0.2},
};

constexpr std::array px4_rates{
    MessageRate{id<messages::HighresImu>, 10},
    MessageRate{id<messages::NavControllerOutput>, 2},
    MessageRate{id<messages::WindCov>, 1},
    MessageRate{id<messages::SystemTime>, 1},
};

constexpr std::array unknown_rates{
    MessageRate{id<messages::Attitude>, 10},
    MessageRate{id<messages::GlobalPositionInt>, 5},
    MessageRate{id<messages::VfrHud>, 4},
    MessageRate{id<messages::SysStatus>, 1},
    MessageRate{id<messages::SystemTime>, 1},
    MessageRate{id<messages::GpsRawInt>, 1},
    MessageRate{id<messages::ScaledPressure>, 1},
    MessageRate{id<messages::BatteryStatus>, 1},
    MessageRate{id<messages::MissionCurrent>, 1},
    MessageRate{id<messages::NavControllerOutput>, 2},
    MessageRate{id<messages::ExtendedSysState>, 2},
    MessageRate{id<messages::HighresImu>, 10},
};
// clang-format on

constexpr std::array singles{id<messages::AutopilotVersion>, id<messages::HomePosition>};

}  // namespace

std::span<const StreamGroup> stream_groups_for(Stack stack) {
  const bool is_ardupilot = stack == Stack::ardupilot_copter || stack == Stack::ardupilot_plane;
  return is_ardupilot ? std::span<const StreamGroup>{ardupilot_groups} : std::span<const StreamGroup>{};
}

std::span<const MessageRate> message_rates_for(Stack stack) {
  switch (stack) {
    case Stack::ardupilot_copter:
    case Stack::ardupilot_plane: return ardupilot_rates;
    case Stack::px4: return px4_rates;
    case Stack::unknown: return unknown_rates;
  }
  return {};
}

std::span<const mavlink::MessageId> single_messages_for(Stack) { return singles; }

}  // namespace ponte::autopilot
