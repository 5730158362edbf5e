#pragma once

#include "ponte/autopilot/target.hpp"
#include "ponte/autopilot/wishes.hpp"

#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// What can be wished of a gimbal.
enum class GimbalWish : std::uint8_t { find_manager, find_mount, take_control, release_control, point, look_at };

using GimbalRequestId = WishId<GimbalWish>;
/// A manager is found when it has told of itself, and control is taken or released when its status says so; the other
/// wishes are done when they are accepted.
using GimbalFact = WishFact<GimbalWish>;

/// Why a wish is not even sent.
enum class GimbalError : std::uint8_t {
  not_found,       ///< no gimbal has been found yet
  not_in_control,  ///< somebody else has, or nobody: `take_control` first
  not_supported,   ///< the old mounts know angles from the nose only
  invalid,         ///< not a number, or out of range
  home_unknown,    ///< the altitude of home has not come yet, which PX4 has to be told
  not_sent,        ///< see `CommandError`: too much is under way, or MAVLink 0.9
};

/// What yaw counts from.
enum class YawFrame : std::uint8_t { nose, north };

/// Where a gimbal is to point. What is left open stays as it is.
struct Pointing {
  std::optional<Radians> pitch{};  ///< from the horizon, up positive
  std::optional<Radians> yaw{};    ///< to the right positive
  YawFrame frame{YawFrame::nose};
};

/// How fast a gimbal is to turn, until it is told otherwise.
struct Turning {
  RadiansPerSecond pitch{};
  RadiansPerSecond yaw{};
  YawFrame frame{YawFrame::nose};
};

/// Points the gimbal of a vehicle through its autopilot: by the gimbal manager, version 2, whose control is taken and
/// given up; or, where there is none, by the commands of the old mounts. The newest wish of where to point counts.
class GimbalClient {
 public:
  static constexpr Duration patience = std::chrono::seconds{6};  ///< a manager tells its status every 5 s at least

  enum class Kind : std::uint8_t { none, manager, mount };

  /// The commands outlive it.
  explicit GimbalClient(CommandClient& commands);

  /// Asks the autopilot for a manager.
  Result<GimbalRequestId, GimbalError> find_manager(Timestamp now, Voice& voice);
  /// For autopilots without one: has the mount take what MAVLink says.
  Result<GimbalRequestId, GimbalError> find_mount(Timestamp now, Voice& voice);
  /// For ourselves, also from somebody else. A mount knows no control, and is found with it.
  Result<GimbalRequestId, GimbalError> take_control(Timestamp now, Voice& voice);
  /// If we have it.
  Result<GimbalRequestId, GimbalError> release_control(Timestamp now, Voice& voice);

  Result<GimbalRequestId, GimbalError> point(Timestamp now, const Pointing& pointing, Voice& voice);
  Result<GimbalRequestId, GimbalError> turn(Timestamp now, const Turning& turning, Voice& voice);
  /// At a place, whatever the vehicle does; nothing: ahead again.
  Result<GimbalRequestId, GimbalError> look_at(Timestamp now, const std::optional<Target>& place, Voice& voice);

  /// Any frame with the right checksum; those of other systems are passed over. `voice` tells who we are.
  void on_message(Timestamp now, const mavlink::FrameView& frame, const Voice& voice, Outbox<GimbalFact>& facts);
  /// What the commands have to tell. True: it was for this client.
  bool on_answer(Timestamp now, const CommandFact& answer, Outbox<GimbalFact>& facts);
  void on_tick(Timestamp now, Outbox<GimbalFact>& facts);
  [[nodiscard]] std::optional<Timestamp> next_deadline() const { return wishes_.next_deadline(); }
  void on_reboot(Timestamp now, Outbox<GimbalFact>& facts);

  [[nodiscard]] Kind kind() const { return kind_; }
  [[nodiscard]] bool is_in_control() const { return is_in_control_; }
  /// GIMBAL_MANAGER_CAP_FLAGS of a manager.
  [[nodiscard]] std::uint32_t capabilities() const { return capabilities_; }

  struct Attitude {
    Radians pitch{};
    Radians yaw{};
    YawFrame frame{};
    Timestamp heard{};
  };
  /// Where it points, as it says itself; nothing until it has.
  [[nodiscard]] const std::optional<Attitude>& attitude() const { return attitude_; }

 private:
  Result<GimbalRequestId, GimbalError> ask(Timestamp now, GimbalWish wish, const Command& command, Voice& voice);
  Result<GimbalRequestId, GimbalError> configure(Timestamp now, GimbalWish wish, float system, float component,
                                                 Voice& voice);
  [[nodiscard]] std::optional<GimbalError> refusal() const;
  [[nodiscard]] Command pitch_yaw(YawFrame frame) const;
  [[nodiscard]] bool is_seen(GimbalWish wish, Timestamp since) const;

  CommandClient& commands_;
  Wishes<GimbalWish> wishes_;
  Kind kind_{Kind::none};
  std::uint8_t device_{};
  std::uint32_t capabilities_{};
  Timestamp found_at_{};
  bool is_in_control_{};
  Timestamp status_at_{};
  std::optional<Attitude> attitude_;
};

}  // namespace ponte::autopilot
