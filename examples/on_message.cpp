// on_message: reads what a serial line delivers from stdin, and tells attitudes, texts and unknown messages.
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/dispatcher.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>

int main() {
  using namespace ponte;
  using namespace ponte::mavlink::autopilots;

  mavlink::Dispatcher dispatcher;
  dispatcher.on<Attitude>([](const Attitude& attitude, const mavlink::FrameView& frame) {
    std::printf("system %d rolls %.3f rad\n", frame.system.value, static_cast<double>(attitude.roll));
  });
  dispatcher.on<Statustext>([](const Statustext& status, const mavlink::FrameView&) {
    const auto text = status.text.view();
    std::printf("says \"%.*s\"\n", static_cast<int>(text.size()), text.data());
  });
  dispatcher.on_every_frame([](const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
    if (message == nullptr) std::printf("unknown message %u\n", frame.message.value);
  });

  mavlink::Parser parser{dialect};
  std::array<std::byte, 4096> buffer{};
  ssize_t size = 0;
  while ((size = read(STDIN_FILENO, buffer.data(), buffer.size())) > 0) {
    const Timestamp now{std::chrono::steady_clock::now().time_since_epoch()};
    parser.on_bytes(now, Bytes{buffer}.first(static_cast<std::size_t>(size)), dispatcher);
  }
  parser.finish(dispatcher);
  std::printf("%llu frames\n", static_cast<unsigned long long>(parser.counters().frames));
}
