// own_dialect: a message of one's own (lamps.xml), from C++ to bytes and back.
#include "ponte/core/hex.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/lamps/dialect.hpp"
#include "ponte/mavlink/lamps/lamp.hpp"

#include <array>
#include <cstdio>
#include <string>

int main() {
  using namespace ponte;
  using mavlink::lamps::Lamp;

  const Lamp lamp{.state = mavlink::lamps::LAMP_STATE_ON, .temperature = 41.5F};
  std::array<std::byte, mavlink::max_frame_size> buffer{};
  const auto size = mavlink::encode(lamp, {.system = mavlink::SystemId{9}}, buffer);
  if (!size) return 1;
  const auto bytes = Bytes{buffer}.first(*size);
  std::printf("%s\n", to_hex(bytes).c_str());

  const auto frame = mavlink::parse_frame(bytes);
  const auto* message = mavlink::lamps::dialect.find(frame->message);
  const auto decoded = mavlink::decode<Lamp>(*frame);
  Lamp::visit(decoded, [](const mavlink::FieldInfo& field, auto value) {
    std::printf("%s = %g %s\n", std::string{field.name}.c_str(), static_cast<double>(value),
                std::string{field.unit}.c_str());
  });
  return message == &Lamp::info && decoded == lamp ? 0 : 1;
}
