#pragma once

#include "latency/latency_probe.hpp"
#include "ponte/transport/loop.hpp"
#include "ponte/vsm/latency_study.hpp"
#include "ponte/vsm/view/bridge_view.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace ponte::app {

/// The latency study on a VSM that is at work: takes samples from its crossings, and tells how far it is.
class LiveStudy {
 public:
  /// A study fails when no sample comes for so long.
  static constexpr Duration patience = std::chrono::seconds{30};

  /// The view is told, and outlives the study.
  LiveStudy(transport::Loop& loop, const dli::Profile& profile, vsm::view::BridgeView& view);

  /// False: one is running.
  [[nodiscard]] bool start(std::uint64_t samples, double limit_ms);
  void stop();
  void on_crossing(const vsm::Crossing& crossing);
  /// The last finished study as "json", "csv" or "html"; nothing when there is none.
  [[nodiscard]] std::optional<std::string> result(std::string_view format) const;

 private:
  void take(const vsm::LatencySample& sample);
  void fail();
  void tell(vsm::view::StudyState state, std::string_view detail = {});

  transport::Loop& loop_;
  vsm::view::BridgeView& view_;
  LatencyProbe probe_;
  std::uint64_t wanted_{};
  bool is_running_{};
  vsm::LatencyStudy running_;
  std::optional<vsm::LatencyStudy> finished_;
  transport::Timer patience_timer_;
};

}  // namespace ponte::app
