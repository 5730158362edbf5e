#pragma once

#include "common/capture.hpp"
#include "common/json_line.hpp"
#include "ponte/mavlink/json.hpp"

namespace ponte::app {

/// Prints every frame as a JSON line. Passes everything on to another sink.
class MessagePrinter final : public CaptureSink {
 public:
  explicit MessagePrinter(CaptureSink& next) : next_{next} {}

  void on_frame(std::size_t offset, std::optional<WallTime> time, const mavlink::FrameView& frame,
                const mavlink::MessageInfo* message) override {
    mavlink::append_frame(json_, time.value_or(WallTime{}), frame, message);
    print_line(json_);
    next_.on_frame(offset, time, frame, message);
  }
  void on_damage(std::size_t offset, std::optional<WallTime> time, Bytes bytes, std::string_view reason) override {
    next_.on_damage(offset, time, bytes, reason);
  }

 private:
  CaptureSink& next_;
  JsonText json_;
};

}  // namespace ponte::app
