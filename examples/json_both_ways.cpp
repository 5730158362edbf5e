// json_both_ways: each line of JSON on stdin becomes a frame, and the frame a line of JSON again.
#include "ponte/core/hex.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/json.hpp"
#include "ponte/reflection/message_json.hpp"

#include <array>
#include <cstdio>
#include <iostream>
#include <string>

int main() {
  using namespace ponte;
  for (std::string line; std::getline(std::cin, line);) {
    const auto read = reflection::message_from_json(line, mavlink::autopilots::dialect);
    if (!read) {
      std::printf("refused: %s\n", to_text(read.error()).c_str());
      continue;
    }
    std::array<std::byte, mavlink::max_frame_size> buffer{};
    const auto size = mavlink::write_frame(read->header, *read->message, read->payload(), buffer);
    if (!size) {
      std::printf("refused: the message needs MAVLink 2\n");
      continue;
    }
    const auto bytes = Bytes{buffer}.first(*size);
    JsonText json;
    mavlink::append_frame(json, WallTime{}, *mavlink::parse_frame(bytes), read->message);
    std::printf("%s\n%s\n", to_hex(bytes).c_str(), json.text().c_str());
  }
}
