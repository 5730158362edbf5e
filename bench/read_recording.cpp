// Times what a VSM does with the frames of a recording, in this process: finding and checking them, and turning them
// into DLI bytes. Prints one JSON object per figure for bench/run.py, which measures the peer.

#include "common/load_file.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/mavlink/tlog.hpp"
#include "ponte/vsm/telemetry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace {

using namespace ponte;
using Clock = std::chrono::steady_clock;

constexpr int repetitions = 15;
constexpr std::size_t chunk_size = 1500;

/// The frames of a recording back to back, as they were on the wire.
std::vector<std::byte> stream_of(Bytes file) {
  std::vector<std::byte> stream;
  mavlink::TlogReader reader{file, mavlink::autopilots::dialect};
  while (const auto part = reader.next())
    if (const auto* record = std::get_if<mavlink::TlogRecord>(&*part))
      stream.insert(stream.end(), record->frame.whole.begin(), record->frame.whole.end());
  return stream;
}

struct CountingSink final : mavlink::FrameSink {
  void on_frame(const mavlink::FrameView&, const mavlink::MessageInfo*) override { ++frames; }
  std::uint64_t frames{};
};

/// Frames per second, the best of several passes.
double parse_rate(Bytes stream) {
  double best = 0;
  for (int pass = 0; pass < repetitions; ++pass) {
    mavlink::Parser parser{mavlink::autopilots::dialect};
    CountingSink sink;
    const auto start = Clock::now();
    for (std::size_t at = 0; at < stream.size(); at += chunk_size)
      parser.on_bytes(Timestamp{}, stream.subspan(at, std::min(chunk_size, stream.size() - at)), sink);
    parser.finish(sink);
    const std::chrono::duration<double> elapsed = Clock::now() - start;
    best = std::max(best, static_cast<double>(sink.frames) / elapsed.count());
  }
  return best;
}

/// Nanoseconds from a frame to the DLI bytes it calls for, for every frame, sorted.
std::vector<double> translation_times(Bytes file) {
  std::vector<double> times;
  for (int pass = 0; pass < repetitions; ++pass) {
    vsm::Telemetry telemetry{{}};
    Outbox<vsm::OutgoingMessage> outbox{64};
    mavlink::TlogReader reader{file, mavlink::autopilots::dialect};
    std::optional<WallTime> first;
    while (const auto part = reader.next()) {
      const auto* record = std::get_if<mavlink::TlogRecord>(&*part);
      if (record == nullptr || record->message == nullptr) continue;
      if (!first) first = record->time;
      const Timestamp now{record->time - *first};
      const auto start = Clock::now();
      telemetry.on_frame(now, record->time, record->frame, *record->message, outbox);
      times.push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count());
      outbox.drain([](const vsm::OutgoingMessage&) {});
    }
  }
  std::ranges::sort(times);
  return times;
}

void print(std::string_view name, double value, std::string_view unit) {
  JsonText json;
  json.begin_object().member("case", name).member("value", value).member("unit", unit).end_object();
  fmt::print("{}\n", json.text());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: bench_read_recording FILE.tlog[.gz]\n");
    return 2;
  }
  const auto file = app::load_file(argv[1]);
  const auto stream = stream_of(file.bytes);
  print("parse", parse_rate(stream), "frames/s");
  const auto times = translation_times(file.bytes);
  const auto quantile = [&](double part) {
    return times[static_cast<std::size_t>(part * static_cast<double>(times.size() - 1))];
  };
  print("translate p50", quantile(0.5), "ns");
  print("translate p99", quantile(0.99), "ns");
  return 0;
}
