#include "latency/study_run.hpp"

#include "common/failure.hpp"
#include "common/realtime.hpp"

#include <fmt/format.h>

#include <numeric>
#include <utility>

namespace ponte::app {
namespace {

vsm::BridgeConfig every_sample(const vsm::TelemetryConfig& telemetry) {
  vsm::BridgeConfig config;
  config.telemetry = telemetry;
  config.rates = vsm::TelemetryRates{};
  return config;
}

}  // namespace

StudyRun::StudyRun(const StudyPlan& plan, Log log, std::function<void(std::size_t)> on_sample)
    : plan_{plan},
      on_sample_{std::move(on_sample)},
      vsm_{loop_, every_sample(plan.telemetry), std::move(log)},
      probe_{loop_, plan.telemetry.profile, [this](const vsm::LatencySample& sample) { take(sample); }},
      patience_{loop_, [this](Timestamp) {
                  failure_ = what_was_heard();
                  loop_.stop();
                }} {
  samples_.reserve(plan.samples);
  vsm_.add_vehicle(plan.vehicle);
  if (!plan.dli) station_ = std::make_unique<LocalStation>(loop_);
  vsm_.add_dli(plan.dli ? *plan.dli : station_->place());
  vsm_.observe_crossings([this](const Crossing& crossing) { probe_.take(crossing); });
  loop_.on_signal([this](int) {
    failure_ = "interrupted";
    loop_.stop();
  });
}

StudyData StudyRun::run() {
  if (plan_.realtime) enter_realtime(*plan_.realtime);
  const WakeupWatch wakeups{loop_};
  patience_.set(loop_.now() + plan_.patience);
  loop_.run();
  vsm_.log_counters();
  if (!failure_.empty())
    throw Failure{fmt::format("{}: {} of {} samples: {}", transport::to_text(plan_.vehicle), samples_.size(),
                              plan_.samples, failure_)};
  return {std::move(samples_), wakeups.late_us()};
}

void StudyRun::take(const vsm::LatencySample& sample) {
  if (samples_.size() == plan_.samples) return;
  samples_.push_back(sample);
  patience_.set(loop_.now() + plan_.patience);
  on_sample_(samples_.size());
  if (samples_.size() == plan_.samples) loop_.stop();
}

std::string StudyRun::what_was_heard() const {
  std::uint64_t frames = 0;
  std::uint64_t noise = 0;
  for (const auto& link : vsm_.bridge().links()) {
    const auto& counters = link->parser.counters();
    frames += counters.frames;
    noise = std::accumulate(counters.skipped.begin(), counters.skipped.end(), noise);
  }
  const auto wait = fmt::format("{} s", std::chrono::duration<double>(plan_.patience).count());
  if (!samples_.empty()) return fmt::format("the vehicle has sent no ATTITUDE for {}", wait);
  if (frames == 0 && noise == 0)
    return fmt::format("nothing was heard in {}; is the vehicle on, and does it send there?", wait);
  if (frames == 0) return fmt::format("{} bytes and no MAVLink frame came in {}; is the baud rate right?", noise, wait);
  if (vsm_.bridge().telemetry().vehicle_count() == 0)
    return fmt::format("{} frames came in {}, but no HEARTBEAT of an autopilot", frames, wait);
  return fmt::format("{} frames came in {}, but no ATTITUDE, though it was asked for", frames, wait);
}

}  // namespace ponte::app
