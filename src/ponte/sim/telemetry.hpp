#pragma once

#include "ponte/mavlink/frame_sender.hpp"
#include "ponte/mavlink/message_info.hpp"
#include "ponte/sim/battery.hpp"
#include "ponte/sim/failsafe.hpp"
#include "ponte/sim/flight.hpp"
#include "ponte/sim/gimbal.hpp"
#include "ponte/sim/message_rates.hpp"
#include "ponte/sim/personality.hpp"
#include "ponte/sim/sensors.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace ponte::sim {

/// How well the satellites are seen, as GPS_FIX_TYPE numbers it.
enum class SatelliteFix : std::uint8_t { no_receiver = 0, none = 1, flat = 2, full = 3 };

/// The newest epoch of the satellite receiver.
struct SatelliteEpoch {
  SatelliteFix fix{};
  Duration at{};  ///< since the start of the autopilot
  SatelliteReading reading{};
};

/// How far the mission is. `current` counts as this autopilot's items do.
struct MissionProgress {
  std::uint16_t current{};
  std::uint16_t items{};               ///< stored, ArduPilot's home included
  std::uint8_t state{};                ///< MISSION_STATE
  bool is_flown{};                     ///< in its mode, armed or not
  std::array<std::uint32_t, 3> ids{};  ///< of mission, fence and rally points
};

/// The item of the mission that was done last, and when, since the start of the autopilot.
struct ReachedItem {
  std::uint16_t item{};
  Duration at{};
};

/// Everything that the autopilot knows at one step; messages are made of this alone.
struct Snapshot {
  Duration since_boot{};
  std::optional<WallTime> utc{};  ///< nothing before the satellites tell it
  bool is_ready{};                ///< the autopilot has started up
  bool has_position{};            ///< it knows where it is, or believes to
  bool trusts_position{};         ///< it relies on that
  bool found_position{};          ///< in this step, for the first time
  bool armed{};
  VehicleKind kind{};
  FlightMode mode{};
  LandedState landed_state{};
  Readings readings{};
  SatelliteEpoch satellites{};
  Position origin{};                 ///< where it learnt its position
  Position home{};                   ///< where it was armed; as yet the origin
  std::optional<Position> target{};  ///< where it is going
  double throttle{};                 ///< 0 to 1
  BatteryState battery{};
  ChargeState charge{};
  bool is_in_trouble{};  ///< a failsafe has acted
  NorthEastDown wind{};  ///< m/s, where the air goes
  mavlink::SystemId system{};
  MissionProgress mission{};
  std::optional<ReachedItem> reached{};
  GimbalState gimbal{};
};

/// One message that the autopilot can send by itself or when it is asked for.
struct TelemetryRow {
  const mavlink::MessageInfo* info;
  Rate rate;
  /// Sends nothing if there is nothing to tell yet.
  void (*send)(const Snapshot& snapshot, mavlink::FrameSender& sender, Outbox<mavlink::FrameBuffer>& out);
};

/// What an autopilot of this personality and version has, in the order in which the messages of one step are sent.
/// MAVLink 1 carries no message with an id above 255; such a row is there and is not used.
[[nodiscard]] std::span<const TelemetryRow> telemetry_rows(Personality personality, mavlink::Version version);
[[nodiscard]] std::span<const TelemetryRow> telemetry_rows_px4();
[[nodiscard]] std::span<const TelemetryRow> telemetry_rows_v09();
/// The place among these rows of the message with this id, or nothing.
[[nodiscard]] std::optional<std::size_t> find_telemetry_row(std::span<const TelemetryRow> among, mavlink::MessageId id);

}  // namespace ponte::sim
