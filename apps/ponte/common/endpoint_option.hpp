#pragma once

#include "ponte/transport/endpoint.hpp"

#include <string>

namespace ponte::app {

/// The endpoint that an option names. Throws `UsageError` with the part that is wrong and the grammar.
[[nodiscard]] transport::Endpoint endpoint_from(const std::string& option, const std::string& text);

}  // namespace ponte::app
