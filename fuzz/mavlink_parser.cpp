// The streaming parser over any bytes. The first input byte chooses whether checksums are repaired, and from where they
// are repaired a second time, which makes frames overlap; the second chooses the sizes of the pieces in which the rest
// arrives.

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/parser.hpp"
#include "repair_checksums.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

using namespace ponte;
using namespace ponte::mavlink;

struct Place {
  std::size_t offset;
  std::size_t size;
  friend bool operator==(const Place&, const Place&) = default;
};

/// Checks all that a parser hands over against the bytes it was fed.
struct Checker : FrameSink {
  explicit Checker(Bytes fed) : stream{fed} {}

  void on_frame(const FrameView& frame, const MessageInfo* message) override {
    PONTE_ASSERT(message == find_message(autopilot::dialect, frame));
    PONTE_ASSERT(message == nullptr || checksum_matches(frame, message->crc_extra));
    PONTE_ASSERT(message != nullptr || shared == 0);
    PONTE_ASSERT(frame.whole.size() > shared);
    frames.push_back({position, frame.whole.size()});
    go_on(frame.whole);
    shared = 0;
  }
  void on_overlap(std::size_t size) override {
    PONTE_ASSERT(size > 0 && !frames.empty());
    PONTE_ASSERT(size < frames.back().size && position == frames.back().offset + frames.back().size);
    shared = size;
    position -= size;
    shared_in_all += size;
    ++overlaps;
  }
  void on_skipped(Bytes run, SkipReason /*reason*/) override {
    PONTE_ASSERT(!run.empty() && shared == 0);
    go_on(run);
  }
  void go_on(Bytes part) {
    PONTE_ASSERT(part.size() <= stream.size() - position);
    PONTE_ASSERT(std::equal(part.begin(), part.end(), stream.begin() + static_cast<std::ptrdiff_t>(position)));
    position += part.size();
  }

  Bytes stream;
  std::size_t position{};
  std::vector<Place> frames;
  std::size_t shared{};  ///< by the frame that comes next and the last one
  std::size_t shared_in_all{};
  std::size_t overlaps{};
};

void check_accounts(const Parser& parser, const Checker& checker) {
  const auto& counters = parser.counters();
  PONTE_ASSERT(checker.position == checker.stream.size());
  PONTE_ASSERT(counters.bytes == checker.stream.size());
  PONTE_ASSERT(counters.frames == checker.frames.size());
  std::uint64_t sum = 0;
  for (const auto& frame : checker.frames) sum += frame.size;
  for (const auto skipped : counters.skipped) sum += skipped;
  PONTE_ASSERT(sum == counters.bytes + checker.shared_in_all);
  PONTE_ASSERT(counters.overlaps == checker.overlaps);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto input = std::as_bytes(std::span{data, size});
  if (input.size() < 2) return 0;
  std::vector<std::byte> stream(input.begin() + 2, input.end());
  if ((u8(input, 0) & 1U) != 0) {
    repair_checksums(stream, autopilot::dialect);
    const std::size_t second = u8(input, 0) / 2U;
    if (second > 0 && second < stream.size())
      repair_checksums(MutableBytes{stream}.subspan(second), autopilot::dialect);
  }

  Parser whole{autopilot::dialect};
  Checker in_one_piece{stream};
  whole.on_bytes(Timestamp{}, stream, in_one_piece);
  whole.finish(in_one_piece);
  check_accounts(whole, in_one_piece);

  Parser parser{autopilot::dialect};
  Checker in_pieces{stream};
  std::uint32_t state = u8(input, 1);
  for (std::size_t at = 0; at < stream.size();) {
    state = state * 1'664'525U + 1'013'904'223U;
    const auto piece = std::min<std::size_t>(stream.size() - at, 1 + (state >> 24U) % (1U + u8(input, 1)));
    parser.on_bytes(Timestamp{}, Bytes{stream}.subspan(at, piece), in_pieces);
    at += piece;
  }
  parser.finish(in_pieces);
  check_accounts(parser, in_pieces);
  PONTE_ASSERT(in_pieces.frames == in_one_piece.frames);
  PONTE_ASSERT(parser.counters() == whole.counters());

  Parser of_datagrams{autopilot::dialect};
  Checker datagram{stream};
  of_datagrams.on_datagram(stream, datagram);
  check_accounts(of_datagrams, datagram);

  Parser with_silence{autopilot::dialect};
  Checker silent{stream};
  Timestamp now{};
  for (std::size_t at = 0; at < stream.size();) {
    const auto piece = std::min<std::size_t>(stream.size() - at, 1U + u8(input, 1));
    with_silence.on_bytes(now, Bytes{stream}.subspan(at, piece), silent);
    at += piece;
    now += Parser::silence_limit;
    with_silence.on_tick(now, silent);
    PONTE_ASSERT(!with_silence.next_deadline());
  }
  with_silence.finish(silent);
  check_accounts(with_silence, silent);
  return 0;
}
