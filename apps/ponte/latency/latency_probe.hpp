#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/dli/profile.hpp"
#include "ponte/transport/loop.hpp"
#include "ponte/vsm/crossing.hpp"
#include "ponte/vsm/latency_study.hpp"

#include <functional>
#include <vector>

namespace ponte::app {

/// Makes samples from what crosses the bridge: each ATTITUDE that became a #4000 is presented both ways, that is
/// written out as the JSON objects that `ponte` prints, and the time taken.
///
/// That happens when all bytes that came together are worked through, so that no presentation delays a message behind.
class LatencyProbe {
 public:
  using OnSample = std::function<void(const vsm::LatencySample&)>;

  /// The VSM writes by that profile. `on_sample` is called on the loop's thread, never within `take`.
  LatencyProbe(transport::Loop& loop, const dli::Profile& profile, OnSample on_sample);

  void take(const vsm::Crossing& crossing);

 private:
  /// A crossing that waits to be presented, with bytes of its own.
  struct Waiting {
    vsm::LatencySample sample;
    std::vector<std::byte> frame;
    const mavlink::MessageInfo* message;
    vsm::OutgoingMessage inertial_states;
  };

  void present_all();
  void present(Waiting& waiting);

  transport::Loop& loop_;
  dli::Profile profile_;
  OnSample on_sample_;
  std::vector<Waiting> waiting_;  ///< no more than came in one piece
  JsonText json_;
  transport::Timer timer_;
};

}  // namespace ponte::app
