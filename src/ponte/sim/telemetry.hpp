#pragma once

#include "ponte/mavlink/message_info.hpp"
#include "ponte/sim/battery.hpp"
#include "ponte/sim/flight.hpp"
#include "ponte/sim/frame_sender.hpp"
#include "ponte/sim/message_rates.hpp"
#include "ponte/sim/sensors.hpp"

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

/// Everything that the autopilot knows at one step; messages are made of this alone.
struct Snapshot {
  Duration since_boot{};
  std::optional<WallTime> utc{};  ///< nothing before the satellites tell it
  bool is_ready{};                ///< the autopilot has started up
  bool has_position{};
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
  mavlink::SystemId system{};
};

/// One message that the autopilot can send by itself or when it is asked for.
struct TelemetryRow {
  const mavlink::MessageInfo* info;
  Stream stream;
  /// Sends nothing if there is nothing to tell yet.
  void (*send)(const Snapshot& snapshot, FrameSender& sender, Outbox<Frame>& out);
};

/// All of this version, in the order in which those of one step are sent.
[[nodiscard]] std::span<const TelemetryRow> telemetry_rows(mavlink::Version version);
[[nodiscard]] std::span<const TelemetryRow> telemetry_rows_v09();
/// The streams of these rows.
[[nodiscard]] std::span<const Stream> telemetry_streams(mavlink::Version version);
[[nodiscard]] std::span<const Stream> telemetry_streams_v09();
/// The place among the rows of MAVLink 1 and 2 of the message with this id, or nothing.
[[nodiscard]] std::optional<std::size_t> find_telemetry_row(mavlink::MessageId id);

}  // namespace ponte::sim
