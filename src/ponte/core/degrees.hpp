#pragma once

#include "ponte/core/quantity.hpp"

namespace ponte {

/// The inverse of `radians_from_degrees`: degrees that it turns into this very angle, where there are any, and with up
/// to 15 digits if so many do. So what a file says is written with the same meaning, and mostly with the same digits.
[[nodiscard]] double degrees_from_radians(Radians angle);

}  // namespace ponte
