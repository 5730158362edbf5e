#pragma once

#include "web/access.hpp"

#include <string>

namespace ponte::app {

/// Reads `command = "..."` and `watch = "..."`, either of which may be missing, from a TOML file that nobody but its
/// owner can read. Throws `Failure`.
[[nodiscard]] Tokens read_token_file(const std::string& path);

/// Throws `Failure` if a token is too short to be a secret, too long, or good for both roles.
void check_tokens(const std::string& place, const Tokens& tokens);

}  // namespace ponte::app
