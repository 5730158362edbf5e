#include "ponte/autopilot/command_client.hpp"

#include "ponte/mavlink/autopilots/command_cancel.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/home_position.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>
#include <cmath>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using Kind = CommandFact::Kind;

/// More numbers than can be in use at a time, so that one that is can always be kept.
constexpr std::size_t numbers_kept = 2 * CommandClient::capacity;

/// A network that repeats a frame does it at once; the sequence number comes round after 256 frames, which PX4 sends in
/// 0.7 s.
constexpr Duration repeated_within = std::chrono::milliseconds{500};

bool is_place(const Command& command) {
  return !command.frame || (!(std::abs(command.x) > 90) && !(std::abs(command.y) > 180));
}

/// Those results of which the vehicle says more in a text.
bool has_a_reason(std::uint8_t result) {
  return result == messages::MAV_RESULT_TEMPORARILY_REJECTED || result == messages::MAV_RESULT_DENIED ||
         result == messages::MAV_RESULT_FAILED;
}

}  // namespace

CommandClient::CommandClient(const Peer& peer, const CommandTimes& times) : peer_{peer}, times_{times} {
  requests_.reserve(capacity);
  traffic_.reserve(numbers_kept);
}

Result<CommandId, CommandError> CommandClient::request(Timestamp now, const Command& command, Voice& voice) {
  if (voice.version() == mavlink::Version::v0_9) return fail(CommandError::version_0_9);
  if (!is_place(command)) return fail(CommandError::no_such_place);
  if (requests_.size() == capacity) return fail(CommandError::too_many);
  const CommandId id{++last_id_};
  requests_.push_back({.id = id, .command = command, .carrier = carrier_for(command)});
  begin_what_waits(now, voice);
  return id;
}

void CommandClient::cancel(Timestamp now, CommandId request, Voice& voice) {
  const auto found = std::ranges::find(requests_, request, &Request::id);
  if (found == requests_.end() || found->state == State::cancelling || found->state == State::refused) return;
  const bool was_sent = found->state != State::waits;
  found->state = State::cancelling;
  found->deadline = now;
  if (was_sent) send_cancel(now, *found, voice);
}

void CommandClient::withdraw(Timestamp now, CommandId request) {
  const auto found = std::ranges::find(requests_, request, &Request::id);
  if (found == requests_.end()) return;
  found->is_withdrawn = true;
  if (found->state == State::waits) {
    requests_.erase(found);
    return;
  }
  found->end = now + times_.late;
  found->deadline = std::min(found->deadline, now + times_.late);
}

std::vector<CommandClient::Request>::iterator CommandClient::find(std::uint16_t number) {
  return std::ranges::find(requests_, number, [](const Request& request) { return request.command.number; });
}

bool CommandClient::is_first_of_its_number(const Request& request) const {
  const auto is_same = [&](const Request& other) { return other.command.number == request.command.number; };
  return &*std::ranges::find_if(requests_, is_same) == &request;
}

/// As soon as no answer to an earlier copy can arrive any more.
Timestamp CommandClient::may_begin_at(std::uint16_t number) const {
  const auto found = std::ranges::find(traffic_, number, &Traffic::number);
  if (found == traffic_.end() || found->unanswered == 0) return Timestamp{};
  return found->last_sent + times_.late;
}

/// Of those that nobody waits for, the one used longest ago gives way.
CommandClient::Traffic& CommandClient::traffic_of(std::uint16_t number) {
  const auto found = std::ranges::find(traffic_, number, &Traffic::number);
  if (found != traffic_.end()) return *found;
  const auto last_use = [this](const Traffic& traffic) {
    return find(traffic.number) != requests_.end() ? Timestamp::max() : traffic.last_sent;
  };
  if (traffic_.size() == numbers_kept) traffic_.erase(std::ranges::min_element(traffic_, {}, last_use));
  return traffic_.emplace_back(Traffic{.number = number, .last_answer = Timestamp::min()});
}

void CommandClient::begin_what_waits(Timestamp now, Voice& voice) {
  for (auto& each : requests_)
    if (each.state == State::waits && is_first_of_its_number(each) && may_begin_at(each.command.number) <= now)
      send(now, each, voice);
}

void CommandClient::send(Timestamp now, Request& request, Voice& voice) {
  const auto address = [&](auto message) {
    message.target_system = peer_.system.value;
    message.target_component = peer_.component.value;
    return message;
  };
  if (request.carrier == Carrier::command_int) {
    voice.send(address(to_command_int(request.command)));
  } else {
    auto message = address(to_command_long(request.command));
    message.confirmation = request.attempts;
    voice.send(message);
  }
  ++request.attempts;
  request.state = State::asked;
  request.deadline = now + times_.answer;
  note_copy(now, request.command.number);
}

void CommandClient::on_sent_elsewhere(Timestamp now, std::uint16_t number) {
  note_copy(now, number);
  const auto found = find(number);
  if (found == requests_.end() || found->state != State::asked) return;
  if (!found->is_withdrawn && may_be_repeated(found->command, peer_.stack)) found->state = State::waits;
}

void CommandClient::note_copy(Timestamp now, std::uint16_t number) {
  auto& traffic = traffic_of(number);
  if (now >= traffic.last_sent + times_.late) traffic.unanswered = 0;
  ++traffic.unanswered;
  traffic.last_sent = now;
}

void CommandClient::send_cancel(Timestamp now, Request& request, Voice& voice) {
  voice.send(messages::CommandCancel{.target_system = peer_.system.value,
                                     .target_component = peer_.component.value,
                                     .command = request.command.number});
  ++request.cancels;
  request.deadline = now + times_.cancel;
}

void CommandClient::on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice,
                               Outbox<CommandFact>& facts) {
  on_tick(now, voice, facts);
  if (frame.system != peer_.system || frame.component != peer_.component) return;
  if (mavlink::carries<messages::Statustext>(frame)) texts_.on_text(now, mavlink::decode<messages::Statustext>(frame));
  if (mavlink::carries<messages::HomePosition>(frame))
    home_altitude_msl_ = Metres{mavlink::decode<messages::HomePosition>(frame).altitude * 1e-3};
  if (mavlink::carries<messages::CommandAck>(frame)) on_answer(now, frame, voice, facts);
}

void CommandClient::on_answer(Timestamp now, const mavlink::FrameView& frame, Voice& voice,
                              Outbox<CommandFact>& facts) {
  const auto answer = mavlink::decode<messages::CommandAck>(frame);
  const bool is_to_another = (answer.target_system != 0 && answer.target_system != voice.system().value) ||
                             (answer.target_component != 0 && answer.target_component != voice.component().value);
  if (is_to_another) return;
  const auto traffic = std::ranges::find(traffic_, answer.command, &Traffic::number);
  if (traffic == traffic_.end()) return;
  // The network brings a frame twice: the second is not the answer to anything later.
  if (traffic->answer_sequence == frame.sequence && traffic->last_answer > now - repeated_within) return;
  traffic->answer_sequence = frame.sequence;
  traffic->last_answer = now;
  if (answer.result != messages::MAV_RESULT_IN_PROGRESS && traffic->unanswered > 0) --traffic->unanswered;

  const auto found = find(answer.command);
  if (found == requests_.end() || found->state == State::waits || found->state == State::refused) {
    begin_what_waits(now, voice);
    return;
  }
  auto& request = *found;
  if (is_of_before(request, answer.result, traffic->unanswered)) return;
  request.answer = answer;
  switch (answer.result) {
    case messages::MAV_RESULT_IN_PROGRESS:
      if (request.state == State::cancelling) return;
      if (request.state != State::in_progress && !request.is_withdrawn) request.end = now + times_.running;
      request.state = State::in_progress;
      request.deadline = std::min(now + times_.progress, request.end);
      if (!request.is_withdrawn) tell(request, Kind::progress, facts);
      return;
    case messages::MAV_RESULT_ACCEPTED: finish(request, Kind::accepted, facts); break;
    case messages::MAV_RESULT_CANCELLED: finish(request, Kind::cancelled, facts); break;
    default:
      if (request.state != State::cancelling && !request.is_withdrawn &&
          try_otherwise(now, request, answer.result, voice))
        return;
      if (has_a_reason(answer.result)) {
        request.state = State::refused;
        request.deadline = now + times_.reason_after;
        return;
      }
      finish(request, Kind::refused, facts);
  }
  begin_what_waits(now, voice);
}

/// A copy in the carrier or frame that has been given up is answered now.
bool CommandClient::is_of_before(const Request& request, std::uint8_t result, unsigned unanswered) {
  if (result == messages::MAV_RESULT_COMMAND_LONG_ONLY)
    return request.was_recast && request.carrier == Carrier::command_long;
  if (result == messages::MAV_RESULT_COMMAND_INT_ONLY)
    return request.was_recast && request.carrier == Carrier::command_int;
  return result == messages::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME && request.was_reframed && unanswered > 0;
}

/// In the other carrier or frame, once each.
bool CommandClient::try_otherwise(Timestamp now, Request& request, std::uint8_t result, Voice& voice) {
  const auto wanted = result == messages::MAV_RESULT_COMMAND_LONG_ONLY  ? std::optional{Carrier::command_long}
                      : result == messages::MAV_RESULT_COMMAND_INT_ONLY ? std::optional{Carrier::command_int}
                                                                        : std::nullopt;
  if (wanted && *wanted != request.carrier && !request.was_recast) {
    const auto other = recast(request.command, *wanted, home_altitude_msl_);
    if (!other) return false;
    request.command = *other;
    request.carrier = *wanted;
    request.was_recast = true;
  } else if (result == messages::MAV_RESULT_COMMAND_UNSUPPORTED_MAV_FRAME && request.carrier == Carrier::command_int &&
             !request.was_reframed) {
    const auto other = reframed(request.command, home_altitude_msl_);
    if (!other) return false;
    request.command = *other;
    request.was_reframed = true;
  } else {
    return false;
  }
  request.attempts = 0;
  send(now, request, voice);
  return true;
}

void CommandClient::on_tick(Timestamp now, Voice& voice, Outbox<CommandFact>& facts) {
  texts_.on_tick(now);
  for (std::size_t i = 0; i < requests_.size();) {
    const auto size = requests_.size();
    if (requests_[i].state != State::waits && requests_[i].deadline <= now) on_silence(now, requests_[i], voice, facts);
    if (requests_.size() == size) ++i;
  }
  begin_what_waits(now, voice);
}

void CommandClient::on_silence(Timestamp now, Request& request, Voice& voice, Outbox<CommandFact>& facts) {
  switch (request.state) {
    case State::asked:
      if (!request.is_withdrawn && request.attempts < times_.attempts && may_be_repeated(request.command, peer_.stack))
        return send(now, request, voice);
      return finish(request, Kind::no_answer, facts);
    case State::cancelling:
      if (request.attempts == 0) return finish(request, Kind::cancelled, facts);
      if (request.cancels < times_.cancel_attempts) return send_cancel(now, request, voice);
      return finish(request, Kind::no_answer, facts);
    case State::refused: return finish(request, Kind::refused, facts);
    case State::in_progress: return finish(request, Kind::no_answer, facts);
    case State::waits: return;
  }
}

std::optional<Timestamp> CommandClient::next_deadline() const {
  auto next = texts_.next_deadline();
  for (const auto& each : requests_) {
    if (each.state == State::waits && !is_first_of_its_number(each)) continue;
    const auto time = each.state == State::waits ? may_begin_at(each.command.number) : each.deadline;
    if (!next || time < *next) next = time;
  }
  return next;
}

void CommandClient::on_reboot(Outbox<CommandFact>& facts) {
  while (!requests_.empty()) {
    auto& request = requests_.front();
    const bool was_wished =
        request.command.number == messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN && request.state == State::asked;
    finish(request, was_wished ? Kind::accepted : Kind::rebooted, facts);
  }
  texts_.forget();
  home_altitude_msl_.reset();
}

void CommandClient::tell(const Request& request, Kind kind, Outbox<CommandFact>& facts) const {
  CommandFact fact{.kind = kind,
                   .request = request.id,
                   .command = request.command.number,
                   .attempts = request.attempts,
                   .result = request.answer.result,
                   .progress = request.answer.progress,
                   .result_param2 = request.answer.result_param2,
                   .reason = {}};
  if (kind == Kind::refused && request.state == State::refused)
    fact.reason = texts_.since(request.deadline - times_.reason_after - times_.reason_before);
  facts.push(fact);
}

void CommandClient::finish(Request& request, Kind kind, Outbox<CommandFact>& facts) {
  if (!request.is_withdrawn) tell(request, kind, facts);
  requests_.erase(requests_.begin() + (&request - requests_.data()));
}

}  // namespace ponte::autopilot
