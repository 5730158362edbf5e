#include "ponte/sim/wind.hpp"

#include "ponte/sim/airframe.hpp"
#include "ponte/sim/random.hpp"

#include <cmath>

namespace ponte::sim {
namespace {

constexpr double dt = std::chrono::duration<double>{Airframe::step_length}.count();
constexpr double gust_seconds = 3.0;                          // after which a gust has mostly gone
constexpr std::uint64_t wind_stream = 0x5749'4E44'5749'4E44;  // apart from what else is drawn from the seed

}  // namespace

Wind::Wind(const WindConfig& config, std::uint64_t seed)
    : mean_{-std::cos(config.from.value) * config.speed.value, -std::sin(config.from.value) * config.speed.value, 0},
      deviation_{config.gusts * config.speed.value},
      seed_{seed ^ wind_stream} {}

/// The gusts are the Gauss-Markov process of this deviation and time.
NorthEastDown Wind::step() {
  const double stays = 1 - dt / gust_seconds;
  const double comes = deviation_ * std::sqrt(1 - stays * stays);
  const double north = random_normal(seed_, draws_);
  const double east = random_normal(seed_, draws_ + 1);
  draws_ += 2;
  gust_ = {gust_.north * stays + north * comes, gust_.east * stays + east * comes, 0};
  return mean_ + gust_;
}

}  // namespace ponte::sim
