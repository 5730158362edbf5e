#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>

namespace ponte {

/// The seed of the tests whose names say Seeded, which hold for any: `./run soak` sets another one for each round.
inline std::uint64_t chosen_seed() {
  const char* text = std::getenv("PONTE_SEED");
  return text != nullptr ? std::stoull(text) : 1;
}

}  // namespace ponte
