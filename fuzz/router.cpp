// The router between eight links, the last two untrusted, over any bytes with repaired checksums. Links come and go,
// and time passes, as the first bytes have it.

#include "ponte/mavlink/router.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/mavlink/route_filter.hpp"
#include "ponte/mavlink/setup_signing.hpp"
#include "repair_checksums.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <vector>

namespace {

using namespace ponte;
using namespace ponte::mavlink;

constexpr std::uint16_t link_count = 8;
bool is_untrusted(RouteLinkId link) { return link.value > link_count - 2; }

struct Checker : FrameSink {
  explicit Checker(Bytes chosen) : choices{chosen} {
    for (std::uint16_t i = 1; i <= link_count; ++i) add(RouteLinkId{i});
  }

  void add(RouteLinkId link) {
    PONTE_ASSERT(
        router.add_link(link, {.untrusted = is_untrusted(link), .limits = {{MessageId{0}, std::chrono::seconds{1}}}}));
  }
  void on_frame(const FrameView& frame, const MessageInfo* message) override {
    const unsigned choice = choices.empty() ? 0 : u8(choices, count++ % choices.size());
    const RouteLinkId from{static_cast<std::uint16_t>(1 + choice % link_count)};
    now += std::chrono::milliseconds{choice};
    if (choice > 250) {
      router.remove_link(from);
      add(from);
    }
    std::set<RouteLinkId> seen;
    for (const auto to : router.on_frame(now, from, frame, message)) {
      PONTE_ASSERT(to != from && seen.insert(to).second);
      PONTE_ASSERT(frame.message != setup_signing_id);
      PONTE_ASSERT(!is_risky(frame) || (!is_untrusted(to) && !is_untrusted(from)));
    }
  }

  Router router{1};
  Bytes choices;
  std::size_t count{};
  Timestamp now{};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t choice_count = 16;
  std::vector<std::byte> input(size);
  std::ranges::copy(std::as_bytes(std::span{data, size}), input.begin());
  const auto head = std::min(choice_count, size);
  repair_checksums(MutableBytes{input}.subspan(head), autopilots::dialect);
  Checker checker{Bytes{input}.first(head)};
  Parser parser{autopilots::dialect};
  parser.on_datagram(Bytes{input}.subspan(head), checker);
  return 0;
}
