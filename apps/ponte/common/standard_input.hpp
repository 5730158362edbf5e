#pragma once

#include "ponte/transport/line_reader.hpp"

#include <string_view>

namespace ponte::app {

/// Standard input for a `LineReader`. Throws `Failure`, which names the option that asks for it, if it cannot be read.
[[nodiscard]] transport::FileDescriptor open_standard_input(std::string_view option);

}  // namespace ponte::app
