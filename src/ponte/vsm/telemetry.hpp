#pragma once

#include "ponte/autopilot/vehicle_monitor.hpp"
#include "ponte/core/outbox.hpp"
#include "ponte/dli/entity_id.hpp"
#include "ponte/dli/profile.hpp"
#include "ponte/dli/wrapper.hpp"
#include "ponte/dlisession/alert_ids.hpp"
#include "ponte/dlisession/mapping.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

/// The half of a VSM that talks: MAVLink vehicles in, DLI status messages out.
namespace ponte::vsm {

struct TelemetryConfig {
  dli::Profile profile{};
  dli::EntityId vsm{20, dli::EntityType::vsm, 1};
  /// What is told of every vehicle, but for its id: that is the owning code of the VSM, type "vehicle", and the MAVLink
  /// system id.
  dlisession::VehicleDescription description{};
};

/// One encoded message, ready to be sent as a datagram of its own.
struct OutgoingMessage {
  WallTime time{};
  std::size_t size{};
  std::array<std::byte, dli::datagram_size_max> buffer{};

  [[nodiscard]] Bytes bytes() const { return Bytes{buffer}.first(size); }
};

/// How often what is sent, beside "on change" (procedures, section 7).
struct TelemetryRates {
  Duration inertial_pause{};  ///< shortest between two #4000; 0: every attitude and every position is told
  Duration inertial_wait = std::chrono::milliseconds{100};  ///< longest that a position waits for the next attitude
  Duration air_pause{};                                     ///< shortest between two #3009
  Duration air_wait = std::chrono::milliseconds{200};       ///< longest that air data wait for the next VFR_HUD
  Duration body_pause = std::chrono::milliseconds{50};      ///< shortest between two samples of the inertial sensors
  Duration operating_states = std::chrono::seconds{1};
  Duration operating_mode = std::chrono::seconds{2};
  Duration leg = std::chrono::seconds{1};
  Duration vehicle_id = std::chrono::seconds{5};
  Duration heartbeat = std::chrono::seconds{1};
  /// When set, #3002, #3009, #3010 and #4000 leave out the fields whose value is the one told last, but for one message
  /// of each in this time, so that a station that joins late learns everything.
  std::optional<Duration> full_refresh{};
};

/// What a live link can carry without pain: #4000 at 10 Hz, #3009 at 4 Hz, unchanged fields once in five seconds. The
/// pauses are a little shorter, so that what a vehicle says at these rates is passed on as it comes.
[[nodiscard]] constexpr TelemetryRates live_rates() {
  TelemetryRates rates;
  rates.inertial_pause = std::chrono::milliseconds{90};
  rates.air_pause = std::chrono::milliseconds{220};
  rates.full_refresh = std::chrono::seconds{5};
  return rates;
}

/// Turns what MAVLink vehicles say into DLI status messages: one #4000 for every ATTITUDE, one #3009 for every VFR_HUD,
/// one #3010 for inertial samples as they come, up to 20 a second, the others on change and at the rates above. A
/// message carries what was learnt since the last one of its kind. Knows no clock and no socket.
class Telemetry {
 public:
  static constexpr std::size_t vehicle_limit = 250;

  explicit Telemetry(TelemetryConfig config, TelemetryRates rates = {});
  ~Telemetry();
  Telemetry(Telemetry&&) noexcept;
  Telemetry& operator=(Telemetry&&) noexcept;

  /// A good frame of a known message from any sender on the links: vehicles are told apart by system id, ground
  /// stations are listened to for the missions that they upload.
  void on_frame(Timestamp now, WallTime received, const mavlink::FrameView& frame, const mavlink::MessageInfo& message,
                Outbox<OutgoingMessage>& out);
  /// A frame that is known to come from somebody else than a vehicle.
  void on_station_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo& message);
  /// An alert about a vehicle that the vehicle itself cannot tell.
  void raise(mavlink::SystemId system, const vehicle::Alert& alert, WallTime wall, Outbox<OutgoingMessage>& out);
  void on_tick(Timestamp now, WallTime wall, Outbox<OutgoingMessage>& out);
  /// When `on_tick` next has something to do, or earlier.
  [[nodiscard]] Timestamp next_deadline() const { return next_deadline_; }
  /// Sends what waits for more, e.g. at the end of a recording.
  void finish(Timestamp now, WallTime wall, Outbox<OutgoingMessage>& out);

  [[nodiscard]] std::size_t vehicle_count() const;
  /// What is known of a vehicle; nothing for a system that is none.
  [[nodiscard]] const vehicle::State* state_of(mavlink::SystemId system) const;

 private:
  struct Vehicle;

  Vehicle* vehicle_that_sent(const mavlink::FrameView& frame);
  void send_due(Vehicle& vehicle, Timestamp now, WallTime wall, Outbox<OutgoingMessage>& out);
  void send_changes(Vehicle& vehicle, Timestamp now, WallTime wall, Outbox<OutgoingMessage>& out);
  void send_alerts(Vehicle& vehicle, WallTime wall, Outbox<OutgoingMessage>& out);
  template <class M>
  bool send_stream(Vehicle& vehicle, Timestamp now, WallTime wall, Outbox<OutgoingMessage>& out);
  template <class M>
  bool send_news(Vehicle& vehicle, vehicle::Revision since, WallTime wall, Outbox<OutgoingMessage>& out);
  template <class M>
  void send(dli::EntityId source, const M& message, WallTime wall, Outbox<OutgoingMessage>& out);

  TelemetryConfig config_;
  TelemetryRates rates_;
  std::vector<std::unique_ptr<Vehicle>> vehicles_;  ///< by system id, ascending
  Timestamp next_heartbeat_{Timestamp::min()};
  Timestamp next_deadline_{Timestamp::min()};
};

}  // namespace ponte::vsm
