// The services of a station, over an autopilot that says anything. The first byte chooses the autopilot and the version
// of MAVLink; then comes a byte of time, and one that chooses: a wish of the station; or a message of the vehicle, with
// two bytes that choose which one, one with the size of its payload, and the payload; again and again. Whatever it
// says, each request ends exactly once.

#include "ponte/autopilot/vehicle_client.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/autopilots/command_ack.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_information.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_status.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/autopilots/timesync.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace {

using namespace ponte;
using namespace ponte::autopilot;
namespace messages = mavlink::autopilots;

/// Mostly one of those that the services listen to.
const mavlink::MessageInfo& message_at(std::size_t choice) {
  static constexpr std::array listened_to{
      &messages::CommandAck::info,         &messages::Heartbeat::info,
      &messages::ExtendedSysState::info,   &messages::GlobalPositionInt::info,
      &messages::HomePosition::info,       &messages::Statustext::info,
      &messages::Timesync::info,           &messages::GimbalManagerInformation::info,
      &messages::GimbalManagerStatus::info};
  if (choice % 256 < 200) return *listened_to[choice % listened_to.size()];
  const auto all = messages::dialect.messages;
  return *all[choice / 256 % all.size()];
}

class Station {
 public:
  explicit Station(std::uint8_t choice)
      : client_{Peer{mavlink::SystemId{1}, mavlink::ComponentId{1}, static_cast<Stack>(choice & 3U)}},
        sender_{(choice & 4U) != 0 ? mavlink::Version::v1 : mavlink::Version::v2, mavlink::SystemId{255},
                mavlink::ComponentId{190}} {}

  void wait(Duration duration) {
    for (const auto end = now_ + duration; now_ < end;) {
      now_ = std::clamp(client_.next_deadline(), now_, end);
      client_.on_tick(now_, voice_, facts_);
      PONTE_ASSERT(client_.next_deadline() > now_);
      examine();
    }
  }

  void hear(const mavlink::MessageInfo& info, Bytes payload, std::uint8_t sequence) {
    std::array<std::byte, mavlink::max_frame_size> buffer{};
    const mavlink::FrameHeader header{mavlink::Version::v2, mavlink::SystemId{1}, mavlink::ComponentId{1}, sequence};
    const auto place = MutableBytes{buffer}.subspan(mavlink::header_size(header.version), info.full_length);
    std::ranges::copy(payload.first(std::min(payload.size(), place.size())), place.begin());
    const auto size = mavlink::seal_frame(header, info, buffer);
    PONTE_ASSERT(size.has_value());
    const auto frame = mavlink::parse_frame(Bytes{buffer}.first(*size));
    PONTE_ASSERT(frame.has_value());
    client_.on_message(now_, *frame, voice_, facts_);
    examine();
  }

  void wish(std::uint8_t choice) {
    const auto count = [this](bool is_asked) { open_ += is_asked ? 1 : 0; };
    const Target target{Radians{-0.5}, Radians{-0.9}, {Metres{30}}};
    switch (choice % 16) {
      case 0: return count(client_.modes().arm(now_, voice_).has_value());
      case 1: return count(client_.modes().disarm(now_, voice_).has_value());
      case 2: return count(client_.modes().take_off(now_, Metres{20}, voice_).has_value());
      case 3: return count(client_.modes().take_off(now_, {}, voice_).has_value());
      case 4: return count(client_.modes().start_mission(now_, voice_).has_value());
      case 5: return count(client_.modes().change_mode(now_, vehicle::ModeKind::return_home, voice_).has_value());
      case 6: return count(client_.guided().go_to(now_, target, {}, voice_).has_value());
      case 7: return count(client_.guided().change_altitude(now_, {Metres{40}}, voice_).has_value());
      case 8: static_cast<void>(client_.stream().steer(now_, {.north = MetresPerSecond{2}}, voice_)); return;
      case 9: return count(client_.gimbal().find_manager(now_, voice_).has_value());
      case 10: return count(client_.gimbal().take_control(now_, voice_).has_value());
      case 11: return count(client_.gimbal().point(now_, {.pitch = Radians{-1}}, voice_).has_value());
      case 12: return count(client_.camera().take_picture(now_, voice_).has_value());
      case 13: client_.on_reboot(now_, facts_); return examine();
      case 14: return sender_.set_version(static_cast<mavlink::Version>(choice / 16 % 3));
      default: break;
    }
    const auto request = client_.commands().request(
        now_, {.number = static_cast<std::uint16_t>(choice), .x = 1, .y = 1, .frame = messages::MAV_FRAME_GLOBAL},
        voice_);
    count(request.has_value());
    if (request && choice >= 64) client_.commands().cancel(now_, *request, voice_);
  }

  [[nodiscard]] int open() const { return open_; }

 private:
  void examine() {
    PONTE_ASSERT(facts_.overwritten() == 0 && out_.overwritten() == 0);
    facts_.drain([this](const VehicleFact& fact) {
      const auto* command = std::get_if<CommandFact>(&fact);
      const bool is_progress = command != nullptr && !command->is_final();
      if (!is_progress && !std::holds_alternative<StreamFact>(fact)) --open_;
    });
    PONTE_ASSERT(open_ >= 0);
    out_.drain([](const OutgoingFrame& frame) { PONTE_ASSERT(mavlink::parse_frame(frame.bytes()).has_value()); });
  }

  Timestamp now_{std::chrono::seconds{100}};
  VehicleClient client_;
  mavlink::FrameSender sender_;
  Outbox<OutgoingFrame> out_{512};
  Voice voice_{sender_, LinkId{1}, out_};
  Outbox<VehicleFact> facts_{512};
  int open_{};  // requests without an answer
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes input = std::as_bytes(std::span{data, size});
  if (input.empty()) return 0;
  Station station{u8(input, 0)};
  input = input.subspan(1);
  std::uint8_t sequence = 0;
  while (input.size() >= 5) {
    station.wait(std::chrono::milliseconds{u8(input, 0) * 4});
    const auto choice = u8(input, 1);
    if ((choice & 1U) != 0) {
      station.wish(choice >> 1U);
      input = input.subspan(2);
      continue;
    }
    const auto& info = message_at(u16_le(input, 2));
    const auto length = std::min<std::size_t>(u8(input, 4), input.size() - 5);
    station.hear(info, input.subspan(5, length), sequence++);
    input = input.subspan(5 + length);
  }
  station.wait(std::chrono::minutes{4});
  PONTE_ASSERT(station.open() == 0);
  return 0;
}
