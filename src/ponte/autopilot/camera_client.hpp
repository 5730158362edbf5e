#pragma once

#include "ponte/autopilot/wishes.hpp"

#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// What can be wished of a camera.
enum class CameraWish : std::uint8_t { take_picture, take_pictures, stop };

using CameraRequestId = WishId<CameraWish>;
/// Done when accepted: no message that all cameras have tells of a picture.
using CameraFact = WishFact<CameraWish>;

enum class CameraError : std::uint8_t {
  invalid,   ///< an interval that is not above 0, or not a number
  not_sent,  ///< see `CommandError`: too much is under way, or MAVLink 0.9
};

/// Has the camera of a vehicle take pictures, through its autopilot: IMAGE_START_CAPTURE and IMAGE_STOP_CAPTURE. A
/// picture is asked for once only, so that none is taken twice; if no answer comes, nobody knows whether it was taken.
class CameraClient {
 public:
  /// The commands outlive it.
  explicit CameraClient(CommandClient& commands) : wishes_{commands} {}

  Result<CameraRequestId, CameraError> take_picture(Timestamp now, Voice& voice);
  /// One after the other, until `stop`, or `count` of them.
  Result<CameraRequestId, CameraError> take_pictures(Timestamp now, Duration interval,
                                                     std::optional<std::uint16_t> count, Voice& voice);
  Result<CameraRequestId, CameraError> stop(Timestamp now, Voice& voice);

  /// What the commands have to tell. True: it was for this client.
  bool on_answer(Timestamp now, const CommandFact& answer, Outbox<CameraFact>& facts);
  void on_reboot(Timestamp now, Outbox<CameraFact>& facts) { wishes_.on_reboot(now, facts); }

 private:
  Result<CameraRequestId, CameraError> ask(Timestamp now, CameraWish wish, const Command& command, Voice& voice);

  Wishes<CameraWish> wishes_;
  std::uint16_t sequence_{};  // of single pictures, as IMAGE_START_CAPTURE counts them
};

}  // namespace ponte::autopilot
