#pragma once

#include "ponte/vsm/telemetry.hpp"

#include <optional>

namespace ponte::app {

/// The VSM's engine in the time of a recording: what it says depends on the recording alone, not on when it is read.
/// Every sample is told.
class RecordedVsm {
 public:
  explicit RecordedVsm(const vsm::TelemetryConfig& config) : telemetry_{config} {}

  /// The next frame, recorded at that time, or at that of the frame before.
  void on_frame(std::optional<WallTime> time, const mavlink::FrameView& frame, const mavlink::MessageInfo& message,
                Outbox<vsm::OutgoingMessage>& out);
  /// The recording is at its end.
  void finish(Outbox<vsm::OutgoingMessage>& out);

  [[nodiscard]] std::size_t vehicle_count() const { return telemetry_.vehicle_count(); }
  /// From the first frame with a time to the latest.
  [[nodiscard]] Duration length() const { return now_ - Timestamp{}; }

 private:
  vsm::Telemetry telemetry_;
  Timestamp now_{};
  std::optional<WallTime> wall_;
};

}  // namespace ponte::app
