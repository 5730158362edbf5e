#pragma once

#include "common/log.hpp"
#include "ponte/transport/endpoint.hpp"
#include "ponte/transport/loop.hpp"
#include "ponte/vsm/bridge.hpp"
#include "ponte/vsm/crossing.hpp"
#include "ponte/vsm/view/situation.hpp"
#include "vsm/vsm_watcher.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ponte::app {

using vsm::Crossing;

class DliSide;
class RecordingSide;
class VehicleSide;

/// A VSM on real links: the bridge, the endpoints of the vehicles on one side of it, those of the DLI on the other, and
/// the loop's time.
class LiveVsm final : private vsm::BridgeListener {
 public:
  using Observer = std::function<void(const vsm::OutgoingMessage&)>;
  using CrossingObserver = std::function<void(const Crossing&)>;

  /// What goes out on links of vehicles is signed if there is a signer, which outlives us.
  LiveVsm(transport::Loop& loop, const vsm::BridgeConfig& config, Log log, mavlink::Signer* signer = nullptr);
  ~LiveVsm() override;

  /// Listens to vehicles there, or replays a recording, which is translated in its own time, every sample. Throws
  /// `Failure`.
  vsm::VehicleLinkId add_vehicle(const transport::Endpoint& endpoint);
  /// Closes that endpoint; its vehicles are lost. False when there is none of that number.
  bool remove_vehicle(vsm::VehicleLinkId id);
  /// Sends DLI messages there. Throws `Failure`.
  void add_dli(const transport::Endpoint& endpoint);
  /// Whether DLI messages are sent. Vehicles are listened to either way.
  void convert(bool on);
  [[nodiscard]] bool converts() const { return bridge_.converts(); }

  /// Is shown every DLI message that goes out.
  void observe(Observer observer) { observer_ = std::move(observer); }
  /// Is shown every frame, with what it became.
  void observe_crossings(CrossingObserver observer) { crossing_observer_ = std::move(observer); }
  /// Tells everything that happens, until `unwatch` or the watcher's end, which is before ours.
  void watch(VsmWatcher& watcher) { watchers_.push_back(&watcher); }
  void unwatch(VsmWatcher& watcher) { std::erase(watchers_, &watcher); }
  /// Is called when there are recordings only, and all of them are at their end.
  void on_finished(std::function<void()> callback) { finished_ = std::move(callback); }

  /// Says of each endpoint what it carried, lost and refused.
  void log_counters() const;

  [[nodiscard]] const vsm::Bridge& bridge() const { return bridge_; }
  [[nodiscard]] const vsm::BridgeConfig& config() const { return config_; }
  [[nodiscard]] vsm::view::Situation situation() const;

 private:
  friend class DliSide;
  friend class RecordingSide;
  friend class VehicleSide;

  void on_decoded(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;
  void on_translated(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;
  void on_skipped(autopilot::LinkId link, Bytes run, mavlink::SkipReason reason) override;
  void on_refused(autopilot::LinkId link, mavlink::Refusal refusal, std::uint64_t count) override;

  /// What is being read from now on: where it comes from, and when.
  void begin(vsm::VehicleLinkId id, std::string_view link, WallTime time, Timestamp received);
  template <class... Parameters, class... Arguments>
  void tell(void (VsmWatcher::*what)(Parameters...), const Arguments&... arguments) const {
    for (auto* watcher : watchers_) (watcher->*what)(arguments...);
  }
  void send(const vsm::OutgoingMessage& message);
  void send(autopilot::OutgoingFrame frame);
  void send_due();
  void pump();
  void finish_if_all_have();
  [[nodiscard]] autopilot::LinkId new_link_number();
  /// The endpoint that the link is on; nothing when it has ended.
  [[nodiscard]] const VehicleSide* side_of(autopilot::LinkId link) const;
  void tell_fact(vsm::VehicleLinkId link, std::string_view place, const autopilot::FleetFact& fact) const;
  [[nodiscard]] vsm::view::VehicleOnLink describe(const autopilot::FleetSession::Vehicle& vehicle,
                                                  vsm::VehicleLinkId link) const;

  transport::Loop& loop_;
  vsm::BridgeConfig config_;
  mavlink::Signer* signer_;
  vsm::Bridge bridge_;
  Log log_;
  Observer observer_;
  CrossingObserver crossing_observer_;
  std::function<void()> finished_;
  std::vector<std::unique_ptr<VehicleSide>> vehicle_sides_;
  std::vector<std::unique_ptr<RecordingSide>> recordings_;
  std::vector<std::unique_ptr<DliSide>> dli_sides_;
  std::vector<VsmWatcher*> watchers_;
  std::uint16_t last_link_{};
  std::uint32_t last_vehicle_link_{};
  // While bytes are read.
  vsm::VehicleLinkId link_id_{};
  std::string_view link_;
  WallTime time_{};
  Timestamp received_{};
  Timestamp decoded_{};
  std::vector<vsm::OutgoingMessage> sent_;
  transport::Timer timer_;
};

}  // namespace ponte::app
