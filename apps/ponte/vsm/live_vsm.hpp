#pragma once

#include "common/log.hpp"
#include "ponte/transport/endpoint.hpp"
#include "ponte/transport/loop.hpp"
#include "ponte/vsm/bridge.hpp"
#include "vsm/crossing.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace ponte::app {

class DliSide;
class RecordingSide;
class VehicleSide;

/// A VSM on real links: the bridge, the endpoints of the vehicles on one side of it, those of the DLI on the other, and
/// the loop's time.
class LiveVsm final : private vsm::BridgeListener {
 public:
  using Observer = std::function<void(const vsm::OutgoingMessage&)>;
  using CrossingObserver = std::function<void(const Crossing&)>;

  LiveVsm(transport::Loop& loop, const vsm::BridgeConfig& config, Log log);
  ~LiveVsm() override;

  /// Listens to vehicles there, or replays a recording, which is translated in its own time, every sample. Throws
  /// `Failure`.
  void add_vehicle(const transport::Endpoint& endpoint);
  /// Sends DLI messages there. Throws `Failure`.
  void add_dli(const transport::Endpoint& endpoint);
  /// Whether DLI messages are sent. Vehicles are listened to either way.
  void convert(bool on);
  [[nodiscard]] bool converts() const { return bridge_.converts(); }

  /// Is shown every DLI message that goes out.
  void observe(Observer observer) { observer_ = std::move(observer); }
  /// Is shown every frame, with what it became.
  void observe_crossings(CrossingObserver observer) { crossing_observer_ = std::move(observer); }
  /// Is called when there are recordings only, and all of them are at their end.
  void on_finished(std::function<void()> callback) { finished_ = std::move(callback); }

  /// Says of each endpoint what it carried, lost and refused.
  void log_counters() const;

  [[nodiscard]] const vsm::Bridge& bridge() const { return bridge_; }

 private:
  friend class DliSide;
  friend class RecordingSide;
  friend class VehicleSide;

  void on_decoded(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;
  void on_translated(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;

  /// What is being read from now on: where it comes from, and when.
  void begin(std::string_view link, WallTime time, Timestamp received);
  void send(const vsm::OutgoingMessage& message);
  void pump();
  void finish_if_all_have();
  [[nodiscard]] autopilot::LinkId new_link_number();
  [[nodiscard]] std::string name_of(autopilot::LinkId link) const;
  void log_fact(const autopilot::FleetFact& fact) const;

  transport::Loop& loop_;
  vsm::BridgeConfig config_;
  vsm::Bridge bridge_;
  Log log_;
  Observer observer_;
  CrossingObserver crossing_observer_;
  std::function<void()> finished_;
  std::vector<std::unique_ptr<VehicleSide>> vehicle_sides_;
  std::vector<std::unique_ptr<RecordingSide>> recordings_;
  std::vector<std::unique_ptr<DliSide>> dli_sides_;
  std::uint16_t last_link_{};
  // While bytes are read.
  std::string_view link_;
  WallTime time_{};
  Timestamp received_{};
  Timestamp decoded_{};
  std::vector<vsm::OutgoingMessage> sent_;
  transport::Timer timer_;
};

}  // namespace ponte::app
