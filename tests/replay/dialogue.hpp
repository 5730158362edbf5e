#pragma once

#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/tlog.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace ponte::replay {

/// Who speaks in the recordings.
inline constexpr mavlink::SystemId vehicle_system{1};
inline constexpr mavlink::SystemId station_system{255};

/// What an autopilot and a ground station said to one another, oldest first; see tests/recordings/README.md.
class Dialogue {
 public:
  /// One of tests/recordings/dialogues, e.g. "ap_mission_v2".
  explicit Dialogue(std::string_view name);
  Dialogue(const Dialogue&) = delete;
  Dialogue& operator=(const Dialogue&) = delete;

  struct Entry {
    Duration time{};  ///< since the first one
    mavlink::FrameView frame{};
    [[nodiscard]] bool is_of_station() const { return frame.system == station_system; }
  };
  /// The views point into the dialogue.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<std::byte> file_;
  std::vector<Entry> entries_;
};

}  // namespace ponte::replay
