#include "support/world/timeline.hpp"

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/hex.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/mavlink/json.hpp"
#include "ponte/mavlink/parser.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

namespace ponte::world {
namespace {

double seconds_of(Timestamp now) { return std::chrono::duration<double>{now.time_since_epoch()}.count(); }

/// The frames of a piece, one after the other.
struct Describer final : mavlink::FrameSink {
  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override {
    text += fmt::format(" {}/{}", frame.system.value, frame.component.value);
    if (message == nullptr) {
      text += fmt::format(" message {}", frame.message.value);
      return;
    }
    JsonText fields;
    mavlink::append_fields(fields, *message, mavlink::readable_payload(frame, *message));
    text += fmt::format(" {} {}", message->name, fields.text());
  }
  void on_skipped(Bytes run, mavlink::SkipReason /*reason*/) override { text += " [" + to_hex(run, " ") + "]"; }
  std::string text;
};

}  // namespace

Timeline Timeline::chosen() {
  const char* wish = std::getenv("PONTE_TIMELINE");
  return Timeline{wish != nullptr && std::string_view{wish} == "1"};
}

void Timeline::sent(Timestamp now, std::string_view from, std::string_view to, Bytes piece,
                    std::string_view fate) const {
  if (!wanted_) return;
  Describer describer;
  mavlink::Parser{autopilot::dialect}.on_datagram(piece, describer);
  fmt::print("{:12.6f} {} -> {} {}:{}\n", seconds_of(now), from, to, fate, describer.text);
}

void Timeline::happened(Timestamp now, std::string_view whom, std::string_view what) const {
  if (wanted_) fmt::print("{:12.6f} {}: {}\n", seconds_of(now), whom, what);
}

}  // namespace ponte::world
