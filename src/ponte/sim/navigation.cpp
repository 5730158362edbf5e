#include "ponte/sim/navigation.hpp"

#include "ponte/sim/airframe.hpp"
#include "ponte/sim/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ponte::sim {
namespace {

constexpr double dt = std::chrono::duration<double>{Airframe::step_length}.count();
constexpr double drift_acceleration = 0.1;                     // m/s^2
constexpr double fastest_drift = 3.0;                          // m/s
constexpr double correction = 1.0;                             // 1/s, once the satellites are heard again
constexpr std::uint64_t drift_stream = 0x4452'4946'5444'5249;  // apart from what else is drawn from the seed

// Seen in recordings of both.
constexpr Duration ardupilot_trusts_itself_for = std::chrono::seconds{8};
constexpr Duration px4_trusts_itself_for = std::chrono::seconds{5};
constexpr Duration trusts_satellites_after = std::chrono::seconds{3};

}  // namespace

Navigation::Navigation(Personality personality, Duration position_after, std::uint64_t seed)
    : position_after_{position_after},
      trusts_itself_for_{personality == Personality::px4 ? px4_trusts_itself_for : ardupilot_trusts_itself_for},
      drift_direction_{static_cast<double>(random_bits(seed ^ drift_stream, 0) >> 11U) * 0x1p-53 * 2 *
                       std::numbers::pi} {}

void Navigation::step(Duration since_boot, bool hears_satellites) {
  if (hears_satellites) {
    if (silent_since_) heard_since_ = since_boot;
    silent_since_.reset();
    error_ = error_ * (1 - correction * dt);
    const bool is_settled = !had_position_ || since_boot - heard_since_ >= trusts_satellites_after;
    has_position_ = has_position_ || (since_boot >= position_after_ && is_settled);
  } else {
    if (!silent_since_) silent_since_ = since_boot;
    const auto silent = since_boot - *silent_since_;
    has_position_ = has_position_ && silent < trusts_itself_for_;
    const double seconds = std::chrono::duration<double>{silent}.count();
    const double speed = std::min(drift_acceleration * seconds, fastest_drift);
    if (had_position_)
      error_ = error_ + NorthEastDown{std::cos(drift_direction_), std::sin(drift_direction_), 0} * (speed * dt);
  }
  had_position_ = had_position_ || has_position_;
}

}  // namespace ponte::sim
