#pragma once

#include "demo/two_sides.hpp"

#include <string>
#include <string_view>

namespace ponte::app {

/// What the window says beside the two sides.
struct DemoStatus {
  std::string_view vehicle;  ///< endpoint
  std::string_view page;     ///< address of the bridge page
  bool converts{};
};

/// The whole window as text: MAVLink on the left, STANAG 4586 on the right, made for 80 columns and 24 lines.
[[nodiscard]] std::string demo_screen(const TwoSides& sides, const DemoStatus& status);

/// What a run without a window ends with.
[[nodiscard]] std::string demo_summary(const DemoCounts& counts);

}  // namespace ponte::app
