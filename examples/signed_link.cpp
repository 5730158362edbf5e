// signed_link KEYFILE: reads frames from stdin and tells which a link with that key takes; then signs one itself, in
// hex.
#include "ponte/core/hex.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/dispatcher.hpp"
#include "ponte/mavlink/link_guard.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <span>
#include <string>

namespace {

using namespace ponte;

std::string all_of(std::istream& input) { return {std::istreambuf_iterator<char>{input}, {}}; }

/// The calendar's, as signatures carry it.
WallTime now() { return std::chrono::time_point_cast<WallTime::duration>(std::chrono::system_clock::now()); }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::ifstream file{argv[1]};
  const auto text = all_of(file);
  const auto key = mavlink::read_signing_key(std::as_bytes(std::span{text}));
  if (!key) return 1;

  // A program that ends should store `signer.time()`, and begin with it the next time: see signing_store.hpp.
  mavlink::Signer signer{*key, mavlink::SigningTime{}};
  mavlink::LinkGuard guard{{.unsigned_frames = mavlink::UnsignedPolicy::listed}};
  mavlink::Dispatcher dispatcher;
  dispatcher.on_every_frame([&](const mavlink::FrameView& frame, const mavlink::MessageInfo*) {
    const auto refusal = guard.examine(now(), frame, &signer);
    const auto verdict = refusal ? name_of(*refusal) : "taken";
    std::printf("%.*s\n", static_cast<int>(verdict.size()), verdict.data());
  });
  mavlink::Parser parser{mavlink::autopilots::dialect};
  const auto stream = all_of(std::cin);
  parser.on_bytes(Timestamp{}, std::as_bytes(std::span{stream}), dispatcher);
  parser.finish(dispatcher);

  std::array<std::byte, mavlink::max_frame_size> frame{};
  const auto size =
      mavlink::encode(mavlink::autopilots::Heartbeat{}, {.system = mavlink::SystemId{255}}, frame).value();
  constexpr std::uint8_t link_id = 0;
  std::printf("%s\n", to_hex(Bytes{frame}.first(signer.sign(now(), link_id, frame, size))).c_str());
}
