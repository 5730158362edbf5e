#include "ponte/sim/telemetry.hpp"

#include "ponte/sim/telemetry_messages.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

namespace ponte::sim {
namespace {

void send_made(const auto& message, FrameSender& sender, Outbox<Frame>& out) { sender.send(message, out); }

template <class M>
void send_made(const std::optional<M>& message, FrameSender& sender, Outbox<Frame>& out) {
  if (message) sender.send(*message, out);
}

template <class M>
struct Made {
  using type = M;
};
template <class M>
struct Made<std::optional<M>> {
  using type = M;
};

/// The row of the message that `make` makes.
template <auto make>
constexpr TelemetryRow row(Stream stream) {
  using M = typename Made<std::invoke_result_t<decltype(make), const Snapshot&>>::type;
  return {&M::info, stream, [](const Snapshot& snapshot, FrameSender& sender, Outbox<Frame>& out) {
            send_made(make(snapshot), sender, out);
          }};
}

constexpr std::array rows{
    row<heartbeat>(Stream::heartbeat),
    row<attitude_message>(Stream::extra1),
    row<global_position>(Stream::position),
    row<local_position>(Stream::position),
    row<vfr_hud>(Stream::extra2),
    row<sys_status>(Stream::extended_status),
    row<nav_controller_output>(Stream::extended_status),
    row<mission_current>(Stream::extended_status),
    row<gps_raw>(Stream::extended_status),
    row<position_target>(Stream::extended_status),
    row<servo_output>(Stream::rc_channels),
    row<rc_channels>(Stream::rc_channels),
    row<raw_imu>(Stream::raw_sensors),
    row<scaled_pressure>(Stream::raw_sensors),
    row<system_time>(Stream::extra3),
    row<battery_status>(Stream::extra3),
    row<wind>(Stream::extra3),
    row<scaled_imu>(Stream::none),
    row<extended_sys_state>(Stream::none),
    row<home_position>(Stream::none),
    row<gps_global_origin>(Stream::none),
    row<autopilot_version>(Stream::none),
};

constexpr auto streams = [] {
  std::array<Stream, rows.size()> result{};
  std::transform(rows.begin(), rows.end(), result.begin(), [](const TelemetryRow& each) { return each.stream; });
  return result;
}();
static_assert(rows.size() <= MessageRates::capacity);
static_assert(std::all_of(rows.begin(), rows.end(), [](const TelemetryRow& each) { return each.info->id.value < 256; }),
              "MAVLink 1 has to be able to carry them");

}  // namespace

std::span<const TelemetryRow> telemetry_rows() { return rows; }

std::span<const Stream> telemetry_streams() { return streams; }

std::optional<std::size_t> find_telemetry_row(mavlink::MessageId id) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [=](const TelemetryRow& each) { return each.info->id == id; });
  if (found == rows.end()) return std::nullopt;
  return static_cast<std::size_t>(found - rows.begin());
}

}  // namespace ponte::sim
