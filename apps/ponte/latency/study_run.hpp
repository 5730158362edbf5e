#pragma once

#include "common/local_station.hpp"
#include "common/log.hpp"
#include "latency/latency_probe.hpp"
#include "latency/wakeup_watch.hpp"
#include "ponte/transport/endpoint.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/vsm/bridge.hpp"
#include "vsm/live_vsm.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ponte::app {

struct StudyPlan {
  transport::Endpoint vehicle;
  std::optional<transport::Endpoint>
      dli;  ///< nothing: a socket of our own on the loopback interface takes what is sent
  vsm::TelemetryConfig telemetry;
  std::size_t samples{};
  Duration patience{};  ///< for the next sample
  std::optional<int> realtime;
};

/// What was measured.
struct StudyData {
  std::vector<vsm::LatencySample> samples;
  std::vector<double> wakeups_late_us;
};

/// A VSM that runs until there are enough samples.
class StudyRun {
 public:
  /// `on_sample` is called with the count so far. Throws `Failure`.
  StudyRun(const StudyPlan& plan, Log log, std::function<void(std::size_t count)> on_sample);

  /// Throws `Failure`, with what was heard, if a sample does not come in time or the program is interrupted.
  [[nodiscard]] StudyData run();

 private:
  void take(const vsm::LatencySample& sample);
  [[nodiscard]] std::string what_was_heard() const;

  StudyPlan plan_;
  std::function<void(std::size_t count)> on_sample_;
  transport::Loop loop_;
  std::unique_ptr<LocalStation> station_;
  LiveVsm vsm_;
  LatencyProbe probe_;
  std::vector<vsm::LatencySample> samples_;
  std::string failure_;
  transport::Timer patience_;
};

}  // namespace ponte::app
