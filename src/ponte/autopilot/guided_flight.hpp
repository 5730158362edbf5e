#pragma once

#include "ponte/autopilot/mode_client.hpp"
#include "ponte/autopilot/target.hpp"
#include "ponte/autopilot/wishes.hpp"

#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// What can be wished of a vehicle in the air.
enum class GuidedWish : std::uint8_t { go_to, orbit, change_altitude, turn_to, change_speed };

using GuidedRequestId = WishId<GuidedWish>;
/// Of all but the speed, and the heading in ArduPilot, the mode in which the vehicle flies so has been seen when it is
/// done.
using GuidedFact = WishFact<GuidedWish>;

/// Why a wish is not even sent.
enum class GuidedError : std::uint8_t {
  not_supported,     ///< this autopilot has no command for it
  invalid,           ///< not a number, or out of range
  home_unknown,      ///< the altitude of home has not come yet, which this autopilot has to be told
  position_unknown,  ///< nor has the vehicle's position
  not_sent,          ///< see `CommandError`: too much is under way, or MAVLink 0.9
};

/// Leads a vehicle in the air by one command at a time, in the autopilot's guided mode (GUIDED of ArduPilot,
/// AUTO.LOITER of PX4), which it enters by itself. The newest of all wishes where to fly counts.
class GuidedFlight {
 public:
  static constexpr Duration mode_patience = std::chrono::seconds{10};  ///< HEARTBEAT comes once a second, or gets lost

  /// The commands and the modes outlive it and are of the same peer.
  GuidedFlight(CommandClient& commands, const ModeClient& modes);

  /// DO_REPOSITION. The speed (over ground; a plane's through the air) is the autopilot's own if none is given.
  Result<GuidedRequestId, GuidedError> go_to(Timestamp now, const Target& target, std::optional<MetresPerSecond> speed,
                                             Voice& voice);
  /// Round a place, clockwise if the radius is positive: DO_ORBIT in PX4, DO_REPOSITION in ArduPlane. ArduCopter has no
  /// command for it.
  Result<GuidedRequestId, GuidedError> orbit(Timestamp now, const Target& centre, Metres radius,
                                             std::optional<MetresPerSecond> speed, Voice& voice);
  /// Over the place it was sent to last, if it was; else over where it is. DO_REPOSITION.
  Result<GuidedRequestId, GuidedError> change_altitude(Timestamp now, const Height& height, Voice& voice);
  /// The nose of a copter, from north: CONDITION_YAW in ArduPilot, DO_REPOSITION in PX4.
  Result<GuidedRequestId, GuidedError> turn_to(Timestamp now, Radians heading, Voice& voice);
  /// DO_CHANGE_SPEED: over ground, a plane's of ArduPilot through the air.
  Result<GuidedRequestId, GuidedError> change_speed(Timestamp now, MetresPerSecond speed, Voice& voice);

  /// What the commands have to tell. True: it was for this client.
  bool on_answer(Timestamp now, const CommandFact& answer, Outbox<GuidedFact>& facts);
  /// Whenever time has gone by, or the modes have heard something.
  void on_tick(Timestamp now, Outbox<GuidedFact>& facts);
  /// When `on_tick` next has something to do.
  [[nodiscard]] std::optional<Timestamp> next_deadline() const;
  /// The vehicle has started anew: all wishes are over.
  void on_reboot(Timestamp now, Outbox<GuidedFact>& facts);

 private:
  Result<GuidedRequestId, GuidedError> ask(Timestamp now, GuidedWish wish, const Command& command, Voice& voice);
  [[nodiscard]] std::optional<std::uint32_t> mode_of(GuidedWish wish) const;
  [[nodiscard]] std::optional<Target> as_understood(const Target& target) const;
  [[nodiscard]] std::optional<std::uint32_t> guided_mode() const;
  [[nodiscard]] Stack stack() const { return commands_.peer().stack; }

  CommandClient& commands_;
  const ModeClient& modes_;
  Wishes<GuidedWish> wishes_;
  std::optional<Target> target_;  // of the last go_to
};

}  // namespace ponte::autopilot
