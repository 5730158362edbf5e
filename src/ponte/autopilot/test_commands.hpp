#pragma once

#include "ponte/autopilot/mode_client.hpp"
#include "ponte/autopilot/test_station.hpp"
#include "ponte/mavlink/autopilots/command_ack.hpp"
#include "ponte/mavlink/autopilots/command_long.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"

#include <cstdint>
#include <optional>

namespace ponte::autopilot::testing {

/// Commands and modes, what is built on them, and the vehicle whose part the test plays.
class CommandBench {
 public:
  explicit CommandBench(Stack stack, mavlink::Version version = mavlink::Version::v2)
      : station{version}, peer{vehicle_system, autopilot_component, stack} {}

  template <mavlink::Message M>
  void hear(Timestamp now, const M& message) {
    const TestFrame frame{message, vehicle_system, autopilot_component, mavlink::Version::v2, sequence_++};
    commands.on_message(now, frame.view(), station.voice(), answers);
    pass_on(now);
    modes.on_message(now, frame.view(), station.voice(), mode_facts);
  }
  void heartbeat(Timestamp now, std::uint32_t custom_mode, bool armed = true) {
    unsigned base_mode = mavlink::autopilots::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
    if (armed) base_mode |= mavlink::autopilots::MAV_MODE_FLAG_SAFETY_ARMED;
    hear(now,
         mavlink::autopilots::Heartbeat{.base_mode = static_cast<std::uint8_t>(base_mode), .custom_mode = custom_mode});
  }
  void landed_state(Timestamp now, unsigned state) {
    hear(now, mavlink::autopilots::ExtendedSysState{.landed_state = static_cast<std::uint8_t>(state)});
  }
  void answer(Timestamp now, unsigned command, unsigned result = mavlink::autopilots::MAV_RESULT_ACCEPTED) {
    hear(now, mavlink::autopilots::CommandAck{.command = static_cast<std::uint16_t>(command),
                                              .result = static_cast<std::uint8_t>(result)});
  }

  /// What the commands have told, to the modes; the rest stays.
  void pass_on(Timestamp now) {
    for (const auto& each : take(answers))
      if (!modes.on_answer(now, each, station.voice(), mode_facts)) answers.push(each);
  }

  Station station;
  Peer peer;
  CommandClient commands{peer};
  ModeClient modes{commands};
  Outbox<CommandFact> answers{64};
  Outbox<ModeFact> mode_facts{64};

 private:
  std::uint8_t sequence_{};
};

}  // namespace ponte::autopilot::testing
