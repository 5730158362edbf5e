#pragma once

#include "ponte/core/assert.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/frame.hpp"

#include <array>

/// For the tests of this folder and of those above it.
namespace ponte::autopilot::testing {

inline constexpr mavlink::SystemId vehicle_system{1};
inline constexpr mavlink::SystemId station_system{255};
inline constexpr mavlink::ComponentId autopilot_component{1};
inline constexpr mavlink::ComponentId station_component{190};

/// A message as a frame, together with the bytes that the frame is in.
class TestFrame {
 public:
  template <mavlink::Message M>
  explicit TestFrame(const M& message, mavlink::SystemId system = vehicle_system,
                     mavlink::ComponentId component = autopilot_component,
                     mavlink::Version version = mavlink::Version::v2, std::uint8_t sequence = 0) {
    const auto size = mavlink::encode(message, {version, system, component, sequence}, bytes_);
    PONTE_ASSERT(size.has_value());
    const auto view = mavlink::parse_frame(Bytes{bytes_}.first(*size));
    PONTE_ASSERT(view.has_value());
    view_ = *view;
  }
  TestFrame(const TestFrame&) = delete;
  TestFrame& operator=(const TestFrame&) = delete;

  [[nodiscard]] const mavlink::FrameView& view() const { return view_; }

 private:
  std::array<std::byte, mavlink::max_frame_size> bytes_{};
  mavlink::FrameView view_;
};

/// The same as a station sends it.
class StationFrame : public TestFrame {
 public:
  template <mavlink::Message M>
  explicit StationFrame(const M& message, mavlink::Version version = mavlink::Version::v2)
      : TestFrame{message, station_system, station_component, version} {}
};

}  // namespace ponte::autopilot::testing
