#pragma once

#include "common/capture.hpp"
#include "ponte/transport/replay.hpp"

#include <string>
#include <vector>

namespace ponte::app {

/// The good frames of a recording with the times at which they were recorded, in memory.
class Recording final : private CaptureSink {
 public:
  /// Throws `Failure` when the file cannot be read, has no frames, or no times.
  Recording(const std::string& path, const mavlink::Dialect& dialect);

  /// A source that gives each frame once. The recording outlives it.
  [[nodiscard]] transport::ReplaySource replay() const;
  /// "offset 120: checksum" of what was damaged first; empty if nothing was.
  [[nodiscard]] const std::string& first_damage() const { return first_damage_; }

 private:
  struct Entry {
    WallTime time{};
    std::size_t end{};  ///< of the frame in `bytes_`; it begins where the one before ends
  };

  void on_frame(std::size_t offset, std::optional<WallTime> time, const mavlink::FrameView& frame,
                const mavlink::MessageInfo* message) override;
  void on_damage(std::size_t offset, std::optional<WallTime> time, Bytes bytes, std::string_view reason) override;

  std::vector<std::byte> bytes_;
  std::vector<Entry> entries_;
  std::string first_damage_;
  bool has_times_{true};
};

}  // namespace ponte::app
