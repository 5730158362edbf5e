#pragma once

#include <cstddef>
#include <string_view>

namespace ponte {

/// Length of the well-formed UTF-8 sequence that `text`, which is not empty, begins with, or 0.
[[nodiscard]] std::size_t utf8_length(std::string_view text);

}  // namespace ponte
