#pragma once

#include "ponte/mavlink/router.hpp"

#include <optional>
#include <string_view>

namespace ponte::app {

/// "MESSAGE:HZ", e.g. "ATTITUDE:4"; 0 Hz: none at all. Nothing if the text is something else, or no such message is
/// known.
[[nodiscard]] std::optional<mavlink::RouteRules::Limit> route_limit_from(std::string_view text);

}  // namespace ponte::app
