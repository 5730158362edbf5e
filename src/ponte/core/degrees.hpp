#pragma once

#include "ponte/core/quantity.hpp"

namespace ponte {

/// The inverse of `radians_from_degrees`: of the degrees that it turns into this very angle, those with the fewest
/// digits. So what a file says with up to 15 digits is written as it was read.
[[nodiscard]] double degrees_from_radians(Radians angle);

}  // namespace ponte
