// What vehicles may say with right checksums and anything in their fields: the bridge follows them and translates, asks
// for its streams, and what it tells ground stations can be read. The first bytes choose how much comes at a time, and
// how much time passes then.

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/dli/datagram.hpp"
#include "ponte/dli/json.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/vsm/bridge.hpp"
#include "repair_checksums.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace {

using namespace ponte;

constexpr autopilot::LinkId radio{1};

/// Each message of ours is one datagram, whole and in the catalogue.
void read_again(const vsm::OutgoingMessage& message, const dli::Profile& profile) {
  dli::DatagramCounters counters;
  dli::DatagramReader reader{message.bytes(), profile, counters};
  const auto view = reader.next();
  PONTE_ASSERT(view && *view);
  JsonText json;
  PONTE_ASSERT(dli::append_json(json, **view, dli::messages::catalogue, profile, 0));
  PONTE_ASSERT(!reader.next());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t choice_count = 16;
  if (size < choice_count) return 0;
  const auto input = std::as_bytes(std::span{data, size});
  const auto choices = input.first(choice_count);
  std::vector<std::byte> stream(input.begin() + choice_count, input.end());
  mavlink::repair_checksums(stream, autopilot::dialect);

  const vsm::BridgeConfig config;
  vsm::Bridge bridge{config};
  Timestamp now{};
  WallTime wall = wall_time_from_unix_us(1'700'000'000'000'000);
  bridge.on_link_up(now, radio);
  std::size_t turn = 0;
  for (Bytes rest = stream; !rest.empty(); ++turn) {
    const unsigned choice = u8(choices, turn % choice_count);
    const auto piece = std::min<std::size_t>(rest.size(), 1 + choice % 128);
    bridge.on_bytes(now, wall, radio, rest.first(piece));
    rest = rest.subspan(piece);
    const std::chrono::milliseconds pause{choice > 250 ? 5000 : choice / 8};
    now += pause;
    wall += pause;
    if (bridge.next_deadline() <= now) bridge.on_tick(now, wall);
    bridge.messages.drain([&](const vsm::OutgoingMessage& message) { read_again(message, config.telemetry.profile); });
    bridge.frames.drain(
        [](const autopilot::OutgoingFrame& frame) { PONTE_ASSERT(mavlink::parse_frame(frame.bytes())); });
    bridge.facts.drain([](const autopilot::FleetFact&) {});
  }
  bridge.on_link_down(now, wall, radio);
  return 0;
}
