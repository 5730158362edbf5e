#pragma once

#include <string>
#include <string_view>

namespace ponte::app {

/// The text as a gzip file.
[[nodiscard]] std::string gzip(std::string_view text);

}  // namespace ponte::app
