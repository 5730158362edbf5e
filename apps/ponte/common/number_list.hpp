#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace ponte::app {

/// Numbers with commas between them, from `least` to `most` of them and all finite, or nothing.
[[nodiscard]] std::optional<std::vector<double>> numbers_in(std::string_view text, std::size_t least, std::size_t most);

}  // namespace ponte::app
