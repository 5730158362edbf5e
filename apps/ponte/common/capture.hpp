#pragma once

#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"
#include "ponte/mavlink/parser.hpp"

#include <cstdint>
#include <optional>
#include <string_view>

/// Recorded MAVLink traffic in whichever form it was written.
namespace ponte::app {

enum class CaptureFormat : std::uint8_t {
  tlog,       ///< time stamp and frame, again and again
  datagrams,  ///< text: a line "microseconds hex" per datagram
  stream,     ///< bytes of a serial line, without times
};
[[nodiscard]] std::string_view name_of(CaptureFormat format);

/// Receives the content of a capture in its order. `offset` counts from the beginning of the (unpacked) file; in a
/// datagram capture it is that of the line.
class CaptureSink {
 public:
  virtual ~CaptureSink() = default;
  /// `message` is nothing for a message that the dialect does not know.
  virtual void on_frame(std::size_t offset, std::optional<WallTime> time, const mavlink::FrameView& frame,
                        const mavlink::MessageInfo* message) = 0;
  /// Bytes that are no frame, and why.
  virtual void on_damage(std::size_t offset, std::optional<WallTime> time, Bytes bytes, std::string_view reason) = 0;
};

/// What a damaged byte is called: "noise", "checksum", ...
[[nodiscard]] std::string_view name_of(mavlink::SkipReason reason);

/// Finds out the format, and hands everything to `sink`.
CaptureFormat read_capture(Bytes file, const mavlink::Dialect& dialect, CaptureSink& sink);

}  // namespace ponte::app
