#include "common/capture.hpp"

#include "ponte/core/hex.hpp"
#include "ponte/mavlink/tlog.hpp"

#include <algorithm>
#include <charconv>

namespace ponte::app {
namespace {

using mavlink::TlogDamage;
using mavlink::TlogDamageReason;
using mavlink::TlogReader;
using mavlink::TlogRecord;

std::string_view name_of(TlogDamageReason reason) {
  switch (reason) {
    case TlogDamageReason::truncated: return "truncated";
    case TlogDamageReason::checksum: return "checksum";
    case TlogDamageReason::no_frame: return "no frame";
  }
  return "";
}

struct DatagramLine {
  WallTime time;
  std::vector<std::byte> bytes;
};

std::optional<DatagramLine> parse_line(std::string_view line) {
  std::int64_t microseconds{};
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), microseconds);
  if (error != std::errc{} || end == line.data() + line.size() || *end != ' ') return std::nullopt;
  auto bytes = parse_hex(line.substr(static_cast<std::size_t>(end - line.data())));
  if (!bytes) return std::nullopt;
  return DatagramLine{wall_time_from_unix_us(microseconds), std::move(*bytes)};
}

/// Calls `visit(offset, line)` for each line that is not empty or a comment.
template <class Visitor>
void for_each_line(std::string_view text, Visitor&& visit) {
  for (std::size_t offset = 0; offset < text.size();) {
    const auto end = std::min(text.find('\n', offset), text.size());
    auto line = text.substr(offset, end - offset);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!line.empty() && line.front() != '#') visit(offset, line);
    offset = end + 1;
  }
}

std::string_view text_of(Bytes file) { return {reinterpret_cast<const char*>(file.data()), file.size()}; }

bool is_datagram_text(Bytes file) {
  bool first = true;
  bool good = false;
  for_each_line(text_of(file.first(std::min<std::size_t>(file.size(), 8192))), [&](std::size_t, std::string_view line) {
    if (first) good = parse_line(line).has_value();
    first = false;
  });
  return good;
}

/// Gives what a parser finds its place in the file.
class PlacedSink final : public mavlink::FrameSink {
 public:
  explicit PlacedSink(CaptureSink& sink) : sink_{sink} {}

  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override {
    sink_.on_frame(offset, time, frame, message);
    if (moves) offset += frame.whole.size();
  }
  void on_overlap(std::size_t shared) override {
    if (moves) offset -= shared;
  }
  void on_skipped(Bytes run, mavlink::SkipReason reason) override {
    sink_.on_damage(offset, time, run, app::name_of(reason));
    if (moves) offset += run.size();
  }

  std::size_t offset{};
  std::optional<WallTime> time;
  bool moves{};  ///< the offset counts the bytes that were found, not lines of text

 private:
  CaptureSink& sink_;
};

void read_datagrams(Bytes file, const mavlink::Dialect& dialect, CaptureSink& sink) {
  mavlink::Parser parser{dialect};
  PlacedSink placed{sink};
  for_each_line(text_of(file), [&](std::size_t offset, std::string_view line) {
    placed.offset = offset;
    const auto datagram = parse_line(line);
    if (!datagram) {
      sink.on_damage(offset, placed.time, std::as_bytes(std::span{line}), "not a line \"microseconds hex\"");
      return;
    }
    placed.time = datagram->time;
    parser.on_datagram(datagram->bytes, placed);
  });
}

void read_stream(Bytes file, const mavlink::Dialect& dialect, CaptureSink& sink) {
  mavlink::Parser parser{dialect};
  PlacedSink placed{sink};
  placed.moves = true;
  parser.on_bytes(Timestamp{}, file, placed);
  parser.finish(placed);
}

bool has_tlog_record(Bytes file, const mavlink::Dialect& dialect) {
  TlogReader reader{file, dialect};
  while (const auto part = reader.next())
    if (std::holds_alternative<TlogRecord>(*part)) return true;
  return false;
}

void read_tlog(Bytes file, const mavlink::Dialect& dialect, CaptureSink& sink) {
  TlogReader reader{file, dialect};
  std::optional<WallTime> time;
  while (const auto part = reader.next()) {
    if (const auto* record = std::get_if<TlogRecord>(&*part)) {
      time = record->time;
      sink.on_frame(record->offset, record->time, record->frame, record->message);
    } else {
      const auto& damage = std::get<TlogDamage>(*part);
      sink.on_damage(damage.offset, time, file.subspan(damage.offset, damage.length), name_of(damage.reason));
    }
  }
}

}  // namespace

std::string_view name_of(CaptureFormat format) {
  switch (format) {
    case CaptureFormat::tlog: return "tlog";
    case CaptureFormat::datagrams: return "datagram text";
    case CaptureFormat::stream: return "byte stream";
  }
  return "";
}

std::string_view name_of(mavlink::SkipReason reason) {
  switch (reason) {
    case mavlink::SkipReason::noise: return "noise";
    case mavlink::SkipReason::checksum: return "checksum";
    case mavlink::SkipReason::unknown_flag: return "unknown flag";
    case mavlink::SkipReason::truncated: return "truncated";
    case mavlink::SkipReason::unconfirmed: return "unconfirmed";
  }
  return "";
}

CaptureFormat read_capture(Bytes file, const mavlink::Dialect& dialect, CaptureSink& sink) {
  if (is_datagram_text(file)) {
    read_datagrams(file, dialect, sink);
    return CaptureFormat::datagrams;
  }
  if (has_tlog_record(file, dialect)) {
    read_tlog(file, dialect, sink);
    return CaptureFormat::tlog;
  }
  read_stream(file, dialect, sink);
  return CaptureFormat::stream;
}

}  // namespace ponte::app
