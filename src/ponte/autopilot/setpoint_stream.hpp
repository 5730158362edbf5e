#pragma once

#include "ponte/autopilot/mode_client.hpp"

#include <cstdint>
#include <optional>

namespace ponte::autopilot {

/// How a copter is to move, over ground and in the Earth's axes.
struct Motion {
  MetresPerSecond north{};
  MetresPerSecond east{};
  MetresPerSecond down{};
  std::optional<RadiansPerSecond> turn_rate{};  ///< of the nose, clockwise; nothing: the nose is left to the autopilot
};

/// What happens to a stream of setpoints. It ends with one of these but the first.
struct StreamFact {
  enum class Kind : std::uint8_t {
    steers,     ///< the vehicle does what the stream says
    held,       ///< nobody has fed the stream, or it was stopped: the vehicle was told to stay where it is
    mode_left,  ///< the vehicle went to another mode, by itself or as somebody else wished: nothing more is sent
    refused,    ///< it did not enter the mode in which it can be steered
    rebooted,   ///< it has started anew
  } kind{};
  std::uint8_t result{};  ///< MAV_RESULT of a refusal; 0: no answer, or nothing came of it
  Text<159> reason{};     ///< of a refusal
  friend bool operator==(const StreamFact&, const StreamFact&) = default;
};

/// Why a motion is not taken.
enum class StreamError : std::uint8_t {
  not_supported,  ///< planes are not steered by velocities; other autopilots are not known
  invalid,        ///< not a number
  on_the_ground,  ///< or not known to be in the air
  not_sent,       ///< the mode cannot be asked for now (`ModeError`)
};

struct StreamTimes {
  Duration period{std::chrono::milliseconds{200}};  ///< PX4 needs 2 Hz and has 1 s of patience, ArduCopter 3 s
  Duration dead_man{std::chrono::seconds{1}};       ///< without a new motion, then the vehicle is held
  Duration before_switch{std::chrono::seconds{1}};  ///< PX4 enters OFFBOARD only with setpoints there already
  Duration hold{std::chrono::seconds{2}};           ///< for so long it is told to stand still
};

/// Steers a copter by velocities, with a dead-man's switch: as long as `steer` is called often enough, the newest
/// motion is sent again and again; otherwise the vehicle stops. ArduCopter then stays in GUIDED and holds; PX4 goes to
/// AUTO.LOITER, and is told to stand still until it is there, so that the end of the stream is no failsafe.
class SetpointStream {
 public:
  /// The modes outlive it.
  explicit SetpointStream(const Peer& peer, ModeClient& modes, const StreamTimes& times = {});

  /// From now on; the first motion begins the stream, and asks for the mode.
  Result<void, StreamError> steer(Timestamp now, const Motion& motion, Voice& voice);
  /// As if nobody fed it any more.
  void stop(Timestamp now);

  /// What the modes have to tell. True: it was for this stream.
  bool on_mode_fact(Timestamp now, const ModeFact& fact, Outbox<StreamFact>& facts);
  void on_tick(Timestamp now, Voice& voice, Outbox<StreamFact>& facts);
  /// When `on_tick` next has something to do; nothing while there is no stream.
  [[nodiscard]] std::optional<Timestamp> next_deadline() const;
  void on_reboot(Timestamp now, Outbox<StreamFact>& facts);

 private:
  enum class Phase : std::uint8_t { none, before_switch, switching, steering, holding };

  void enter(Timestamp now, Phase phase, Duration lasts);
  void send(Timestamp now, const Motion& motion, Voice& voice);
  void advance(Timestamp now, Voice& voice, Outbox<StreamFact>& facts);
  void begin_holding(Timestamp now, Voice& voice);
  bool ask_for(Timestamp now, vehicle::ModeKind mode, Voice& voice);
  void forget_mode_request(Timestamp now);
  void end(const StreamFact& fact, Outbox<StreamFact>& facts);

  Peer peer_;
  ModeClient& modes_;
  StreamTimes times_;
  Phase phase_{Phase::none};
  Timestamp phase_since_{};
  Timestamp phase_ends_{};  // of before_switch and holding
  Motion motion_;
  Timestamp fed_{};
  Timestamp next_setpoint_{};
  std::optional<ModeRequestId> mode_request_;
};

}  // namespace ponte::autopilot
