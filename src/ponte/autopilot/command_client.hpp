#pragma once

#include "ponte/autopilot/command.hpp"
#include "ponte/autopilot/peer.hpp"
#include "ponte/autopilot/recent_texts.hpp"
#include "ponte/autopilot/voice.hpp"
#include "ponte/core/outbox.hpp"
#include "ponte/core/result.hpp"
#include "ponte/core/text.hpp"
#include "ponte/core/time.hpp"
#include "ponte/mavlink/autopilots/command_ack.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace ponte::autopilot {

/// Names one request of a command for as long as the program runs.
using CommandId = Id<struct CommandIdTag, std::uint32_t>;

/// What became of a request. Each that is not withdrawn ends in exactly one fact that is final.
struct CommandFact {
  enum class Kind : std::uint8_t {
    progress,   ///< not final: it is being done
    accepted,   ///< taken or done; what the vehicle does next is another matter
    refused,    ///< `result` says how, `reason` perhaps why
    cancelled,  ///< as was wished
    no_answer,  ///< in the time there is: whether it was or will be done is not known
    rebooted,   ///< the vehicle has started anew before there was an answer
  } kind{};
  CommandId request{};
  std::uint16_t command{};       ///< MAV_CMD
  std::uint8_t attempts{};       ///< how often it was sent
  std::uint8_t result{};         ///< MAV_RESULT, if there was an answer
  std::uint8_t progress{};       ///< percent, 255 if the vehicle does not know; otherwise what COMMAND_ACK has there
  std::int32_t result_param2{};  ///< as in COMMAND_ACK; 0 in MAVLink 1
  Text<159> reason{};            ///< of a refusal: what the vehicle said about that time, "; " between texts

  [[nodiscard]] bool is_final() const { return kind != Kind::progress; }
  friend bool operator==(const CommandFact&, const CommandFact&) = default;
};

/// Why a command is not even sent.
enum class CommandError : std::uint8_t {
  too_many,       ///< as many as there is room for wait for their answers
  version_0_9,    ///< the vehicle speaks MAVLink 0.9, which has no such commands
  no_such_place,  ///< latitude beyond 90 or longitude beyond 180 degrees
};

/// How long there is patience for what.
struct CommandTimes {
  Duration answer{std::chrono::seconds{1}};  ///< then it is sent again; both MAVSDK and QGroundControl wait 0.5 to 3 s
  std::uint8_t attempts{5};                  ///< of a command that may be repeated; any other has one
  Duration progress{
      std::chrono::seconds{10}};              ///< until the next IN_PROGRESS, which both autopilots send at least 1 Hz
  Duration running{std::chrono::minutes{2}};  ///< of all that is in progress, e.g. a calibration
  Duration late{std::chrono::seconds{2}};     ///< an answer takes no longer: round trip of a radio with full buffers
  Duration reason_before{std::chrono::seconds{2}};        ///< a text of a refusal came so long before it,
  Duration reason_after{std::chrono::milliseconds{500}};  ///< or, in PX4 0.35 s, after it (recordings)
  Duration cancel{std::chrono::seconds{1}};               ///< then it is said again that it be cancelled
  std::uint8_t cancel_attempts{3};
};

/// Has commands carried out by one autopilot over a link that loses, repeats and delays. It chooses COMMAND_LONG or
/// COMMAND_INT, and takes the other one, or another frame of altitude, once, if the vehicle says so; sends again what
/// may be repeated; waits while the vehicle is at it. One command of a number is under way at a time, as COMMAND_ACK
/// names nothing but the number: others wait for it in the order of their requests.
///
/// A late answer is not taken for that to the next request of the same number: that is sent only when all copies of the
/// one before are answered, or when `late` has passed. The protocol cannot tell an answer that takes even longer; nor
/// to whom an answer is, if the vehicle does not fill in the target, as in MAVLink 1, and another station asks for the
/// same at the same time.
class CommandClient {
 public:
  static constexpr std::size_t capacity = 16;

  explicit CommandClient(const Peer& peer, const CommandTimes& times = {});

  /// Sends the command, or lets it wait for others of its number.
  Result<CommandId, CommandError> request(Timestamp now, const Command& command, Voice& voice);
  /// The command shall not be done any more. One that waits is not sent; the vehicle is asked to stop another one,
  /// which not all can. The final fact says what came of it. What has ended already is left alone.
  void cancel(Timestamp now, CommandId request, Voice& voice);
  /// Nobody wants to know any more what becomes of it: no more copies are sent, and no fact is told.
  void withdraw(Timestamp now, CommandId request);

  /// Another part of the program has sent this command in our name: its answer is for none of our requests. One that is
  /// under way is sent again after it, if it may be repeated.
  void on_sent_elsewhere(Timestamp now, std::uint16_t number);

  /// Any frame with the right checksum; those of others are passed over.
  void on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice, Outbox<CommandFact>& facts);
  void on_tick(Timestamp now, Voice& voice, Outbox<CommandFact>& facts);
  /// When `on_tick` next has something to do; nothing while all is answered.
  [[nodiscard]] std::optional<Timestamp> next_deadline() const;
  /// The vehicle has started anew: all requests are over. That to start anew has been followed.
  void on_reboot(Outbox<CommandFact>& facts);

  [[nodiscard]] const Peer& peer() const { return peer_; }
  /// As HOME_POSITION says.
  [[nodiscard]] std::optional<Metres> home_altitude_msl() const { return home_altitude_msl_; }

 private:
  enum class State : std::uint8_t { waits, asked, in_progress, cancelling, refused };
  struct Request {
    CommandId id{};
    Command command;
    Carrier carrier{};
    State state{State::waits};
    Timestamp deadline{};  // of the state, but for `waits`
    Timestamp end{};       // while it is in progress
    std::uint8_t attempts{};
    std::uint8_t cancels{};
    bool was_recast{};
    bool was_reframed{};
    bool is_withdrawn{};
    mavlink::autopilots::CommandAck answer{};  // of a refusal
  };
  /// What has been going on under one command number.
  struct Traffic {
    std::uint16_t number{};
    std::uint8_t unanswered{};  // copies
    Timestamp last_sent{};
    std::uint8_t answer_sequence{};
    Timestamp last_answer{};
  };

  [[nodiscard]] std::vector<Request>::iterator find(std::uint16_t number);
  [[nodiscard]] bool is_first_of_its_number(const Request& request) const;
  [[nodiscard]] Timestamp may_begin_at(std::uint16_t number) const;
  Traffic& traffic_of(std::uint16_t number);
  void begin_what_waits(Timestamp now, Voice& voice);
  void send(Timestamp now, Request& request, Voice& voice);
  void note_copy(Timestamp now, std::uint16_t number);
  void send_cancel(Timestamp now, Request& request, Voice& voice);
  void on_answer(Timestamp now, const mavlink::FrameView& frame, Voice& voice, Outbox<CommandFact>& facts);
  [[nodiscard]] static bool is_of_before(const Request& request, std::uint8_t result, unsigned unanswered);
  bool try_otherwise(Timestamp now, Request& request, std::uint8_t result, Voice& voice);
  void on_silence(Timestamp now, Request& request, Voice& voice, Outbox<CommandFact>& facts);
  void tell(const Request& request, CommandFact::Kind kind, Outbox<CommandFact>& facts) const;
  void finish(Request& request, CommandFact::Kind kind, Outbox<CommandFact>& facts);

  Peer peer_;
  CommandTimes times_;
  std::vector<Request> requests_;  // in the order in which they were made
  std::vector<Traffic> traffic_;
  RecentTexts texts_;
  std::uint32_t last_id_{};
  std::optional<Metres> home_altitude_msl_;
};

}  // namespace ponte::autopilot
