#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace ponte::app {

/// The text before and behind the first such character; nothing behind it when there is none.
[[nodiscard]] std::pair<std::string_view, std::string_view> split(std::string_view text, char at);

/// Throws `UsageError`, which shows the whole option, for what is no number from `least` to `most`.
[[nodiscard]] double number(std::string_view text, const std::string& whole, double least, double most);

}  // namespace ponte::app
