#pragma once

#include "common/log.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/loop.hpp"
#include "ponte/transport/replay.hpp"
#include "ponte/vsm/bridge.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ponte::app {

/// A VSM on real links: the bridge, the endpoints of the vehicles on one side of it, those of the DLI on the other, and
/// the loop's time.
class LiveVsm {
 public:
  using Observer = std::function<void(const vsm::OutgoingMessage&)>;

  LiveVsm(transport::Loop& loop, const vsm::BridgeConfig& config, Log log);
  ~LiveVsm();

  /// Listens to vehicles there. Throws `Failure`.
  void add_vehicle(const transport::Endpoint& endpoint);
  /// Sends DLI messages there. Throws `Failure`.
  void add_dli(const transport::Endpoint& endpoint);
  /// Is shown every DLI message that goes out.
  void observe(Observer observer) { observer_ = std::move(observer); }

  [[nodiscard]] const vsm::Bridge& bridge() const { return bridge_; }

 private:
  class VehicleSide;
  class DliSide;

  void pump();
  void log_fact(const autopilot::FleetFact& fact);

  transport::Loop& loop_;
  vsm::Bridge bridge_;
  Log log_;
  Observer observer_;
  std::vector<std::unique_ptr<VehicleSide>> vehicle_sides_;
  std::vector<std::unique_ptr<DliSide>> dli_sides_;
  std::uint16_t next_link_{1};
  transport::Timer timer_;
};

}  // namespace ponte::app
