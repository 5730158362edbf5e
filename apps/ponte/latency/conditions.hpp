#pragma once

#include "ponte/vsm/latency_study.hpp"

#include <vector>

namespace ponte::app {

/// What the figures depend on as far as the machine and this program are concerned.
[[nodiscard]] std::vector<vsm::LatencyCondition> conditions_of_this_machine();

}  // namespace ponte::app
