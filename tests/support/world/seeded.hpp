#pragma once

#include "support/seed.hpp"
#include "support/world/world.hpp"

#include "ponte/core/random.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

/// What tests share that let many worlds happen, each as good or bad as its seed wants it.
namespace ponte::world {

/// How many worlds: as many as the environment says in PONTE_WORLDS, or this many.
inline int world_count(int without_word) {
  const char* text = std::getenv("PONTE_WORLDS");
  return text != nullptr ? std::stoi(text) : without_word;
}

inline double between(Random& random, double least, double most) { return least + (most - least) * random.unit(); }

/// Up to 30 % of loss, and with bad luck bursts, copies, disorder and damage.
inline ChannelConfig random_radio(Random& random) {
  using std::chrono::milliseconds;
  ChannelConfig radio{.delay = milliseconds{5 + random.below(200)}};
  radio.jitter = milliseconds{random.below(100)};
  radio.loss = random.chance(0.7) ? between(random, 0, 0.3) : 0;
  radio.burst_begins = random.chance(0.3) ? 0.01 : 0;
  radio.duplication = random.chance(0.3) ? 0.05 : 0;
  radio.reordering = random.chance(0.3) ? 0.05 : 0;
  radio.bit_flips = random.chance(0.3) ? 0.0002 : 0;
  return radio;
}

/// Lets so many worlds happen, from the chosen seed on; `run` throws `BrokenProperty` where one goes wrong. `program`
/// is that of the test, for the line that says how to see such a world again.
template <class Run>
void run_worlds(int count, std::string_view program, Run&& run) {
  const auto first = chosen_seed();
  for (auto seed = first; seed < first + static_cast<std::uint64_t>(count); ++seed) {
    try {
      run(seed);
    } catch (const BrokenProperty& broken) {
      ADD_FAILURE() << "world " << seed << ": " << broken.what() << "\nread it: PONTE_SEED=" << seed
                    << " PONTE_WORLDS=1 PONTE_TIMELINE=1 build/dev/bin/" << program;
    }
  }
}

}  // namespace ponte::world
