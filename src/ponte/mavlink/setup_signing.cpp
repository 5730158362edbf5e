#include "ponte/mavlink/setup_signing.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>
#include <array>

namespace ponte::mavlink {
namespace {

constexpr std::size_t system_offset = 8;
constexpr std::size_t component_offset = 9;
constexpr std::size_t key_offset = 10;
constexpr std::size_t payload_size = key_offset + SigningKey::size;
constexpr MessageInfo info{setup_signing_id, "SETUP_SIGNING", 71, payload_size, payload_size, {}};

}  // namespace

std::size_t write_setup_signing(const SetupSigning& setup, SystemId system, ComponentId component,
                                std::uint8_t sequence, MutableBytes out) {
  PONTE_ASSERT(setup.system != SystemId{});
  std::array<std::byte, payload_size> payload{};
  store_le(payload.data(), setup.time.value);
  payload[system_offset] = std::byte{setup.system.value};
  payload[component_offset] = std::byte{setup.component.value};
  if (setup.key) std::ranges::copy(setup.key->secret(), &payload[key_offset]);
  const auto size =
      write_frame({.system = system, .component = component, .sequence = sequence}, info, payload, out).value();
  wipe(payload);
  return size;
}

std::optional<SetupSigning> read_setup_signing(const FrameView& frame) {
  if (frame.version != Version::v2 || frame.message != setup_signing_id) return {};
  std::array<std::byte, payload_size> payload{};
  std::ranges::copy(frame.payload.first(std::min(frame.payload.size(), payload_size)), payload.begin());
  const auto key = Bytes{payload}.subspan<key_offset, SigningKey::size>();
  const bool is_off = std::ranges::all_of(key, [](std::byte byte) { return byte == std::byte{0}; });
  SetupSigning setup{.system = SystemId{u8(payload, system_offset)},
                     .component = ComponentId{u8(payload, component_offset)},
                     .key = is_off ? std::nullopt : std::optional{SigningKey{key}},
                     .time = SigningTime{load_le<std::uint64_t>(payload.data())}};
  wipe(payload);
  if (setup.system == SystemId{}) return {};
  return setup;
}

}  // namespace ponte::mavlink
