#include "web/live_study.hpp"

#include "latency/conditions.hpp"
#include "latency/report.hpp"

#include <utility>

namespace ponte::app {

using vsm::view::EventCode;
using vsm::view::Severity;
using vsm::view::StudyState;

LiveStudy::LiveStudy(transport::Loop& loop, const dli::Profile& profile, vsm::view::BridgeView& view)
    : loop_{loop},
      view_{view},
      probe_{loop, profile, [this](const vsm::LatencySample& sample) { take(sample); }},
      patience_timer_{loop, [this](Timestamp) { fail(); }} {}

bool LiveStudy::start(std::uint64_t samples, double limit_ms) {
  if (is_running_) return false;
  is_running_ = true;
  wanted_ = samples;
  finished_.reset();
  running_ = {.limit = std::chrono::round<Duration>(std::chrono::duration<double, std::milli>{limit_ms}),
              .conditions = conditions_of_this_machine()};
  patience_timer_.set(loop_.now() + patience);
  tell(StudyState::running);
  return true;
}

void LiveStudy::stop() {
  if (!std::exchange(is_running_, false)) return;
  patience_timer_.clear();
  wanted_ = 0;
  running_ = {};
  tell(StudyState::none);
}

void LiveStudy::on_crossing(const vsm::Crossing& crossing) {
  if (is_running_) probe_.take(crossing);
}

void LiveStudy::take(const vsm::LatencySample& sample) {
  if (!is_running_) return;
  running_.samples.push_back(sample);
  patience_timer_.set(loop_.now() + patience);
  if (running_.samples.size() < wanted_) return tell(StudyState::running);
  is_running_ = false;
  patience_timer_.clear();
  finished_ = std::exchange(running_, {});
  running_.limit = finished_->limit;
  tell(StudyState::done);
  view_.events().add({.time = transport::Loop::wall(),
                      .code = EventCode::study_done,
                      .severity = passes(*finished_) ? Severity::info : Severity::warning,
                      .text = verdict_text(*finished_)});
}

void LiveStudy::fail() {
  is_running_ = false;
  constexpr std::string_view why =
      "no ATTITUDE was translated for 30 s; is a vehicle connected, and conversion switched on?";
  tell(StudyState::failed, why);
  view_.events().add({.time = transport::Loop::wall(),
                      .code = EventCode::study_failed,
                      .severity = Severity::error,
                      .text = std::string{why}});
}

void LiveStudy::tell(StudyState state, std::string_view detail) {
  const auto& study = finished_ ? *finished_ : running_;
  const bool any = state != StudyState::none;
  view_.set_study({.state = state,
                   .samples = wanted_,
                   .limit_ms = any ? std::chrono::duration<double, std::milli>(study.limit).count() : 0,
                   .done = study.samples.size(),
                   .detail = std::string{detail}});
}

std::optional<std::string> LiveStudy::result(std::string_view format) const {
  if (!finished_) return std::nullopt;
  if (format == "csv") return csv_text(*finished_);
  if (format == "html") return html_text(*finished_);
  JsonText json;
  append_study(json, *finished_);
  return json.text();
}

}  // namespace ponte::app
