#pragma once

#include "ponte/core/outbox.hpp"
#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/frame_sender.hpp"
#include "ponte/mavlink/message_info.hpp"
#include "ponte/sim/autopilot.hpp"
#include "ponte/sim/config.hpp"
#include "ponte/sim/faults.hpp"
#include "ponte/sim/onboard_memory.hpp"
#include "ponte/sim/radio.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace ponte::sim {

/// One simulated vehicle: an aircraft, and an autopilot that speaks MAVLink to whoever listens. It knows no clock and
/// no socket, allocates nothing, and with the same configuration and the same frames at the same times it sends the
/// same bytes.
class Vehicle {
 public:
  /// No step and no answer has more frames: an outbox of this capacity, emptied after each call, loses nothing as long
  /// as the calls come in time.
  static constexpr std::size_t frames_per_step = 128;

  explicit Vehicle(const VehicleConfig& config);

  // `now` counts from power-on at 0 and never goes back.

  /// A frame from outside, of this known message and with the right checksum.
  void on_frame(Timestamp now, const mavlink::FrameView& frame, const mavlink::MessageInfo& message,
                Outbox<mavlink::FrameBuffer>& out);
  /// Lets the steps go by that are due. After a pause it makes up for all of them.
  void on_tick(Timestamp now, Outbox<mavlink::FrameBuffer>& out);
  /// Something goes wrong, now or later.
  void inject(const Fault& fault) { faults_.add(fault); }
  /// When the next step is due.
  [[nodiscard]] Timestamp next_deadline() const { return step_at(steps_ + 1); }

  /// What is true at the last step, whatever the sensors say.
  [[nodiscard]] const AirframeState& truth() const { return airframe_->state(); }
  /// What is kept on board, whatever is said of it.
  [[nodiscard]] const OnboardMemory& memory() const { return memory_; }
  /// The steps that have gone by, `Airframe::step_length` each.
  [[nodiscard]] std::uint64_t steps() const { return steps_; }

 private:
  [[nodiscard]] static Timestamp step_at(std::uint64_t step) {
    return Timestamp{Airframe::step_length * static_cast<std::int64_t>(step)};
  }

  [[nodiscard]] bool has_fault(FaultKind kind) const { return faults_.is_on(kind, now()); }
  [[nodiscard]] Duration now() const { return step_at(steps_) - Timestamp{}; }
  void step(Outbox<mavlink::FrameBuffer>& out);
  void begin_faults();
  void report_radio(Outbox<mavlink::FrameBuffer>& out);
  void reboot();

  VehicleConfig config_;
  std::unique_ptr<Airframe> airframe_;
  Wind wind_;
  Faults faults_;
  OnboardMemory memory_;
  std::optional<Autopilot> autopilot_;  // nothing while it starts anew
  std::optional<Radio> radio_;
  std::uint64_t steps_{};
  std::uint64_t boot_step_{};
  Outbox<mavlink::FrameBuffer> unheard_{1};  // what is said while the link is lost
};

}  // namespace ponte::sim
