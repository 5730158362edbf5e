#pragma once

#include "ponte/autopilot/command_client.hpp"
#include "ponte/autopilot/flight_watch.hpp"
#include "ponte/vehicle/vocabulary.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ponte::autopilot {

/// Names one wish for as long as the program runs.
using ModeRequestId = Id<struct ModeRequestIdTag, std::uint32_t>;

/// What can be wished.
enum class ModeWish : std::uint8_t { change_mode, arm, disarm, take_off, start_mission };
/// What is done about a wish, one after the other.
enum class ModeStep : std::uint8_t { set_mode, arm, disarm, take_off, start_mission };

/// What became of a wish. Each that is not withdrawn ends in exactly one of these.
struct ModeFact {
  enum class Kind : std::uint8_t {
    done,        ///< the vehicle was seen to do it: in the mode, armed, in the air
    refused,     ///< `step` was, with `result` and `reason`
    no_answer,   ///< to `step`, and nothing was seen of its effect
    no_effect,   ///< all was accepted, but nothing was seen of it
    superseded,  ///< by the next wish
    rebooted,    ///< the vehicle has started anew meanwhile
  } kind{};
  ModeRequestId request{};
  ModeWish wish{};
  ModeStep step{};        ///< as far as it came
  std::uint8_t result{};  ///< MAV_RESULT of a refusal
  Text<159> reason{};     ///< of a refusal, as in `CommandFact`
  friend bool operator==(const ModeFact&, const ModeFact&) = default;
};

/// Why a wish is not even begun.
enum class ModeError : std::uint8_t {
  not_heard,       ///< no HEARTBEAT has come for `ModeTimes::news`, or none yet
  no_such_mode,    ///< in this autopilot
  unknown_stack,   ///< nobody knows how this autopilot takes off
  in_the_air,      ///< it has taken off already
  needs_height,    ///< this autopilot has none of its own to take off to
  has_own_height,  ///< this autopilot takes off to its own height only (a plane's TKOFF_ALT)
  height_invalid,  ///< not above the ground, or not a number
  home_unknown,    ///< the altitude of home has not come yet, which this autopilot has to be told
  not_sent,        ///< see `CommandError`: too much is under way, or MAVLink 0.9
};

/// How long there is patience for an effect, once its command was accepted.
struct ModeTimes {
  Duration mode{std::chrono::seconds{10}};    ///< told by HEARTBEAT once a second, of which some get lost
  Duration flight{std::chrono::seconds{40}};  ///< spinning up, or a run of a plane, and the first metres
  Duration news{std::chrono::seconds{10}};    ///< what was heard longer ago says nothing of where the vehicle is
  Duration doubt{std::chrono::seconds{3}};    ///< for a step without an answer, or refused only as it was repeated
};

/// Changes modes, arms, and lets flights begin, each autopilot in its own way, and watches that it comes true. One wish
/// is under way at a time, the newest: whoever wishes to return does not wait for a take-off, only, at the most
/// `CommandTimes::late`, until an older wish for a mode cannot arrive behind the new one. Nothing is ever forced past
/// the checks of the vehicle.
///
/// A mission begins from the ground in ArduCopter by GUIDED, arming and MISSION_START with parameters 0, in ArduPlane
/// and PX4 by arming in the mission's mode; in the air by the mode alone. A take-off is, in ArduCopter, NAV_TAKEOFF in
/// GUIDED with a height above home; in PX4, NAV_TAKEOFF with an altitude above mean sea level; in ArduPlane the mode
/// TAKEOFF.
class ModeClient {
 public:
  /// The commands outlive it and are of the same peer.
  explicit ModeClient(CommandClient& commands, const ModeTimes& times = {});

  Result<ModeRequestId, ModeError> change_mode(Timestamp now, vehicle::ModeKind kind, Voice& voice);
  /// To one of the autopilot's own, by its name in `modes_of`.
  Result<ModeRequestId, ModeError> change_mode(Timestamp now, std::string_view name, Voice& voice);
  Result<ModeRequestId, ModeError> arm(Timestamp now, Voice& voice);
  Result<ModeRequestId, ModeError> disarm(Timestamp now, Voice& voice);
  /// Off the ground and to a height above home; nothing: to the autopilot's own.
  Result<ModeRequestId, ModeError> take_off(Timestamp now, std::optional<Metres> height, Voice& voice);
  /// The one on board, from the ground or in the air.
  Result<ModeRequestId, ModeError> start_mission(Timestamp now, Voice& voice);

  /// Nobody wants to know any more what becomes of it: nothing more is done for it, and no fact is told.
  void withdraw(Timestamp now, ModeRequestId request);

  /// Any frame with the right checksum; those of others are passed over.
  void on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice, Outbox<ModeFact>& facts);
  /// What the commands have to tell. True: it was for this client.
  bool on_answer(Timestamp now, const CommandFact& answer, Voice& voice, Outbox<ModeFact>& facts);
  void on_tick(Timestamp now, Outbox<ModeFact>& facts);
  /// When `on_tick` next has something to do; nothing while nothing is watched for.
  [[nodiscard]] std::optional<Timestamp> next_deadline() const;
  /// The vehicle has started anew: the wish is over, and what was known is forgotten.
  void on_reboot(Timestamp now, Outbox<ModeFact>& facts);

  [[nodiscard]] const FlightWatch& watch() const { return watch_; }

 private:
  /// The last of a wish's steps is `count - 1`.
  struct Plan {
    ModeWish wish{};
    std::array<ModeStep, 3> steps{};
    std::size_t count{};
    std::uint32_t mode{};        // of the step set_mode
    std::uint32_t final_mode{};  // in which the mission is flown
    float height{};              // what NAV_TAKEOFF is given
  };
  enum class Phase : std::uint8_t { asked, doubtful, accepted };
  struct Running {
    ModeRequestId id{};
    Plan plan;
    std::size_t at{};
    Phase phase{};
    CommandId command{};
    Timestamp step_began{};
    Timestamp deadline{};  // but while asked
    CommandFact answer{};  // while doubtful
  };

  Result<ModeRequestId, ModeError> begin(Timestamp now, const Plan& plan, Voice& voice);
  Result<ModeRequestId, ModeError> begin_flight(Timestamp now, Plan plan, Voice& voice);
  bool ask(Timestamp now, Voice& voice);
  [[nodiscard]] bool is_in_the_air(Timestamp now) const { return watch_.is_in_the_air(now - times_.news); }
  [[nodiscard]] Command command_for(const Plan& plan, ModeStep step) const;
  [[nodiscard]] bool is_effect_seen() const;
  [[nodiscard]] bool is_step_seen() const;
  void on_accepted(Timestamp now, Voice& voice, Outbox<ModeFact>& facts);
  void look(Timestamp now, Voice& voice, Outbox<ModeFact>& facts);
  void finish(ModeFact::Kind kind, Outbox<ModeFact>& facts);
  [[nodiscard]] ModeFact fact(ModeFact::Kind kind) const;
  void drain_superseded(Outbox<ModeFact>& facts);

  CommandClient& commands_;
  ModeTimes times_;
  FlightWatch watch_;
  std::uint32_t last_id_{};
  std::optional<Running> running_;
  static constexpr std::size_t most_superseded = 16;  // between two calls that can tell of them
  Outbox<ModeFact> superseded_{most_superseded};
  std::optional<Timestamp> superseded_at_;
};

}  // namespace ponte::autopilot
