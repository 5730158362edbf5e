// The simulated autopilots, over any messages of their dialect. The first byte chooses the personality and the
// aircraft; then comes a byte of time, two that choose a message, one with the size of its payload, and the payload,
// again and again. Targets are mostly the vehicle's own, or few messages would get past the first look.

#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/sim/vehicle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace {

using namespace ponte;

const mavlink::MessageInfo& message_at(std::size_t choice) {
  const auto all = mavlink::autopilots::dialect.messages;
  return *all[choice % all.size()];
}

sim::VehicleConfig config_for(std::uint8_t choice) {
  sim::VehicleConfig config;
  const bool is_px4 = (choice & 1U) != 0;
  config.personality = is_px4 ? sim::Personality::px4 : sim::Personality::ardupilot;
  config.type = (choice & 2U) != 0 ? sim::AirframeType::plane : sim::AirframeType::copter;
  config.fly_square = false;
  config.parameters = {is_px4 ? sim::ParameterSetting{"MNT_MODE_IN", 4} : sim::ParameterSetting{"MNT1_TYPE", 1}};
  return config;
}

/// Hands every frame that the vehicle sends to a check, and empties the outbox.
void examine(Outbox<mavlink::FrameBuffer>& out) {
  PONTE_ASSERT(out.overwritten() == 0);
  out.drain([](const mavlink::FrameBuffer& frame) { PONTE_ASSERT(mavlink::parse_frame(frame.bytes()).has_value()); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes input = std::as_bytes(std::span{data, size});
  if (input.empty()) return 0;
  sim::Vehicle vehicle{config_for(u8(input, 0))};
  input = input.subspan(1);
  Outbox<mavlink::FrameBuffer> out{sim::Vehicle::frames_per_step};
  Timestamp now{};
  const auto wait = [&](Duration duration) {
    for (const auto end = now + duration; now < end;) {
      now = std::min(end, vehicle.next_deadline());
      vehicle.on_tick(now, out);
      examine(out);
    }
  };
  wait(std::chrono::seconds{9});

  while (input.size() >= 4) {
    wait(std::chrono::milliseconds{u8(input, 0)});
    const auto& info = message_at(u16_le(input, 1));
    const auto length = std::min<std::size_t>({u8(input, 3), input.size() - 4, info.full_length});
    std::array<std::byte, mavlink::max_frame_size> buffer{};
    const mavlink::FrameHeader header{mavlink::Version::v2, mavlink::SystemId{255}, mavlink::ComponentId{190}, 0};
    const auto payload = MutableBytes{buffer}.subspan(mavlink::header_size(header.version), info.full_length);
    std::copy_n(input.begin() + 4, length, payload.begin());
    input = input.subspan(4 + length);
    const auto frame_size = mavlink::seal_frame(header, info, buffer);
    PONTE_ASSERT(frame_size.has_value());
    const auto frame = mavlink::parse_frame(Bytes{buffer}.first(*frame_size));
    PONTE_ASSERT(frame.has_value());
    vehicle.on_frame(now, *frame, info, out);
    examine(out);
    const auto& truth = vehicle.truth();
    PONTE_ASSERT(std::isfinite(truth.position.latitude.value) && std::isfinite(truth.position.altitude_msl.value));
  }
  wait(std::chrono::seconds{1});
  return 0;
}
