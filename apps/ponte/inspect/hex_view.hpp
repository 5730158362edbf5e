#pragma once

#include "common/capture.hpp"
#include "ponte/core/json_text.hpp"

#include <string>

namespace ponte::app {

/// Shows a capture byte by byte: frames with their start byte, console text between them as text, and what is neither
/// in hex. Passes everything on to another sink.
class HexView final : public CaptureSink {
 public:
  HexView(CaptureSink& next, bool json) : next_{next}, json_lines_{json} {}

  void on_frame(std::size_t offset, std::optional<WallTime> time, const mavlink::FrameView& frame,
                const mavlink::MessageInfo* message) override;
  void on_damage(std::size_t offset, std::optional<WallTime> time, Bytes bytes, std::string_view reason) override;
  /// Shows what is still held back.
  void finish() { flush(); }

 private:
  void flush();
  void print(std::string_view kind, std::size_t offset, std::optional<WallTime> time, Bytes bytes,
             std::string_view words);

  CaptureSink& next_;
  bool json_lines_;
  JsonText json_;
  // Bytes that are no frame arrive in pieces; they are shown together.
  std::vector<std::byte> run_;
  std::string run_reasons_;
  std::size_t run_offset_{};
  std::optional<WallTime> run_time_;
};

}  // namespace ponte::app
