#include "inspect/hex_view.hpp"

#include "common/json_line.hpp"
#include "ponte/core/hex.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ponte::app {
namespace {

constexpr std::size_t shortest_text = 4;

bool is_text(std::byte byte) {
  const auto c = std::to_integer<unsigned char>(byte);
  return (c >= 0x20 && c < 0x7F) || c == '\t' || c == '\n' || c == '\r';
}

bool is_start_byte(std::byte byte) {
  return byte == mavlink::start_v2 || byte == mavlink::start_v1 || byte == mavlink::start_v0_9;
}

/// The start bytes among `bytes`, e.g. "start bytes 0xFD 0xFE"; empty if there are none.
std::string start_bytes_in(Bytes bytes) {
  std::string words;
  for (const auto byte : bytes)
    if (is_start_byte(byte)) words += fmt::format(" 0x{:02X}", std::to_integer<unsigned>(byte));
  return words.empty() ? words : "start bytes" + words;
}

/// How many printable characters `bytes` begins with.
std::size_t text_size(Bytes bytes) {
  return static_cast<std::size_t>(std::ranges::find_if_not(bytes, is_text) - bytes.begin());
}

/// Where the first stretch of printable characters that is long enough to be text begins, or the size. A run that is
/// printable to its end is text, however short.
std::size_t find_text(Bytes bytes) {
  if (text_size(bytes) == bytes.size()) return 0;
  for (std::size_t at = 0; at < bytes.size();) {
    const auto size = text_size(bytes.subspan(at));
    if (size >= shortest_text) return at;
    at += size + 1;
  }
  return bytes.size();
}

std::string escaped(std::string_view text) {
  JsonText json;
  json.value(text);
  return json.text();
}

}  // namespace

void HexView::on_frame(std::size_t offset, std::optional<WallTime> time, const mavlink::FrameView& frame,
                       const mavlink::MessageInfo* message) {
  flush();
  const auto name = message != nullptr ? std::string{message->name} : fmt::format("unknown:{}", frame.message.value);
  print("frame", offset, time, frame.whole,
        fmt::format("0x{:02X} {} system {} component {} sequence {}{}", u8(frame.whole, 0), name, frame.system.value,
                    frame.component.value, frame.sequence, frame.is_signed() ? " signed" : ""));
  next_.on_frame(offset, time, frame, message);
}

void HexView::on_damage(std::size_t offset, std::optional<WallTime> time, Bytes bytes, std::string_view reason) {
  if (!run_.empty() && run_time_ != time) flush();
  if (run_.empty()) {
    run_offset_ = offset;
    run_time_ = time;
    run_reasons_.clear();
  }
  run_.insert(run_.end(), bytes.begin(), bytes.end());
  if (run_reasons_.find(reason) == std::string::npos) {
    if (!run_reasons_.empty()) run_reasons_ += ", ";
    run_reasons_ += reason;
  }
  next_.on_damage(offset, time, bytes, reason);
}

/// Stretches of printable characters are shown as text, the bytes between them in hex.
void HexView::flush() {
  for (std::size_t at = 0; at < run_.size();) {
    const auto rest = Bytes{run_}.subspan(at);
    const auto before_text = find_text(rest);
    const auto size = before_text > 0 ? before_text : text_size(rest);
    const auto bytes = rest.first(size);
    if (before_text > 0)
      print("bytes", run_offset_ + at, run_time_, bytes, fmt::format("{} {}", run_reasons_, start_bytes_in(bytes)));
    else
      print("text", run_offset_ + at, run_time_, bytes,
            escaped({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
    at += size;
  }
  run_.clear();
}

void HexView::print(std::string_view kind, std::size_t offset, std::optional<WallTime> time, Bytes bytes,
                    std::string_view words) {
  if (json_lines_) {
    json_.begin_object().member("kind", kind).member("offset", std::uint64_t{offset});
    if (time) json_.member("time_us", unix_us(*time));
    json_.member("hex", std::string_view{to_hex(bytes)}).member("words", words).end_object();
    print_line(json_);
    return;
  }
  const auto when = time ? fmt::format("{:.6f}", static_cast<double>(unix_us(*time)) * 1e-6) : std::string{"-"};
  fmt::print("{:>17} {:>8} {:<5} {}\n{}{}\n", when, offset, kind, words, "                           ",
             to_hex(bytes, " "));
}

}  // namespace ponte::app
