// Times how fast the frames of a recording are found and checked.

#include "ponte/mavlink/parser.hpp"
#include "recording.hpp"

#include <chrono>

namespace {

using namespace ponte;
using Clock = std::chrono::steady_clock;

constexpr int repetitions = 15;
constexpr std::size_t chunk_size = 1500;

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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: bench_parse FILE.tlog[.gz]\n");
    return 2;
  }
  const auto file = app::load_file(argv[1]);
  std::vector<std::byte> stream;  // the frames back to back, as they were on the wire
  bench::for_each_frame(file.bytes, [&](const mavlink::TlogRecord& record) {
    stream.insert(stream.end(), record.frame.whole.begin(), record.frame.whole.end());
  });
  bench::print("parse", parse_rate(stream), "frames/s");
  return 0;
}
