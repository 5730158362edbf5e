#pragma once

#include "ponte/core/assert.hpp"
#include "ponte/core/hex.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace ponte {

/// The bytes of a hex text such as "fd 09 00", which is a literal of a test and therefore well formed.
[[nodiscard]] inline std::vector<std::byte> bytes(std::string_view hex) {
  auto result = parse_hex(hex);
  PONTE_ASSERT(result);
  return *std::move(result);
}

}  // namespace ponte
