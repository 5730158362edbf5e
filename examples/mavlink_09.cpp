// mavlink_09: reads MAVLink of 2011 from stdin, and asks every vehicle that rolls too far to fly home, in hex.
#include "ponte/core/hex.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/dispatcher.hpp"
#include "ponte/mavlink/v09/action.hpp"
#include "ponte/mavlink/v09/attitude.hpp"
#include "ponte/mavlink/v09/dialect.hpp"
#include "ponte/mavlink/v09/enums.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

int main() {
  using namespace ponte;
  using namespace ponte::mavlink::v09;

  mavlink::Dispatcher dispatcher;
  dispatcher.on<Attitude>([](const Attitude& attitude, const mavlink::FrameView& heard) {
    if (std::abs(attitude.roll) < 1) return;
    const Action action{.target = heard.system.value, .target_component = 1, .action = MAV_ACTION_RETURN};
    const mavlink::FrameHeader header{
        .version = mavlink::Version::v0_9, .system = mavlink::SystemId{255}, .component = mavlink::ComponentId{190}};
    std::array<std::byte, mavlink::max_frame_size> frame{};
    if (const auto size = mavlink::encode(action, header, frame))
      std::printf("%s\n", to_hex(Bytes{frame}.first(*size)).c_str());
  });

  // One that speaks newer versions, too, has messages as well as those of 0.9.
  const mavlink::Dialect only_old{.name = "only old", .messages = {}, .v09 = &dialect};
  mavlink::Parser parser{only_old};
  std::array<std::byte, 4096> buffer{};
  ssize_t size = 0;
  while ((size = read(STDIN_FILENO, buffer.data(), buffer.size())) > 0) {
    const Timestamp now{std::chrono::steady_clock::now().time_since_epoch()};
    parser.on_bytes(now, Bytes{buffer}.first(static_cast<std::size_t>(size)), dispatcher);
  }
  parser.finish(dispatcher);
}
