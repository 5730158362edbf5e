#pragma once

#include "ponte/mavlink/signing_key.hpp"

#include <string>

namespace ponte::app {

/// Reads the key in a file that nobody but its owner may use; `read_signing_key` says what is in it. Throws `Failure`,
/// which never repeats what was read.
[[nodiscard]] mavlink::SigningKey read_signing_key_file(const std::string& path);

}  // namespace ponte::app
