#pragma once

#include "ponte/vsm/latency_study.hpp"

#include <string>

namespace ponte::app {

/// A study as one HTML page, also well-formed XML, that needs nothing beside itself: verdict, conditions, summaries and
/// the three charts of 2016. Light or dark as the reader's system. The study has samples.
[[nodiscard]] std::string html_text(const vsm::LatencyStudy& study);

/// The linear trend of the delay: "delay = 12.34 us + 0.005 us x sample". The study has samples.
[[nodiscard]] std::string trend_text(const vsm::LatencyStudy& study);

/// "PASS: the greatest delay, 0.081 ms, is below the limit of 500 ms", or the opposite. The study has samples.
[[nodiscard]] std::string verdict_text(const vsm::LatencyStudy& study);

}  // namespace ponte::app
