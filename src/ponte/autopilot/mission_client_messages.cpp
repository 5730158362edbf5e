#include "ponte/autopilot/mission_client.hpp"

#include "ponte/autopilot/kept_plan.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/mission_ack.hpp"
#include "ponte/mavlink/autopilots/mission_count.hpp"
#include "ponte/mavlink/autopilots/mission_request.hpp"
#include "ponte/mavlink/autopilots/mission_request_int.hpp"
#include "ponte/mavlink/codec.hpp"

namespace ponte::autopilot {

namespace messages = mavlink::autopilots;

void MissionClient::on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice,
                               Outbox<MissionFact>& facts) {
  if (frame.version == mavlink::Version::v0_9) return;
  if (frame.system != route_.peer.system || frame.component != route_.peer.component) return;
  /// Decodes the message, and hands it on if it is for us and about the plan that is transferred. What the vehicle asks
  /// others for, or acknowledges to them, may change a plan that we know.
  const auto handle = [&]<class Message>(Message, bool tells_of_changes, auto&& act) {
    const auto message = mavlink::decode<Message>(frame);
    const bool is_ours = voice.is_addressed(message.target_system, message.target_component);
    if (!is_ours && tells_of_changes) note_foreign(message.mission_type);
    if (!is_ours || message.mission_type != static_cast<std::uint8_t>(route_.type)) return;
    act(message);
    go_on(now, voice, facts);
  };
  const auto serve = [&](const auto& request) { on_request(now, request.seq, voice, facts); };
  switch (frame.message.value) {
    case messages::MissionRequest::info.id.value: return handle(messages::MissionRequest{}, true, serve);
    case messages::MissionRequestInt::info.id.value: return handle(messages::MissionRequestInt{}, true, serve);
    case messages::MissionAck::info.id.value:
      return handle(messages::MissionAck{}, true,
                    [&](const messages::MissionAck& ack) { on_ack(now, ack.type, voice, facts); });
    case messages::MissionCount::info.id.value:
      return handle(messages::MissionCount{}, false, [&](const messages::MissionCount& count) {
        if (step_ == Step::reading) download_.on_count(now, count.count, count.opaque_id, voice);
      });
    case messages::MissionItemInt::info.id.value:
      return handle(messages::MissionItemInt{}, false, [&](const WireItem& item) {
        if (step_ == Step::reading) download_.on_item(now, item, voice);
      });
    case messages::MissionCurrent::info.id.value:
      return on_current(now, mavlink::decode<messages::MissionCurrent>(frame), facts);
    default: return;
  }
}

/// A vehicle that asks while its plan is read back has begun the upload again, by a late copy of our announcement.
void MissionClient::on_request(Timestamp now, std::uint16_t item, Voice& voice, Outbox<MissionFact>& facts) {
  const bool has_begun_again = step_ == Step::reading && (aim_ == Aim::upload || failure_);
  if (step_ != Step::uploading && !has_begun_again) return;
  upload_.on_request(now, item, voice);
  if (upload_.state() != TransferState::running) return;
  step_ = Step::uploading;
  tell_progress(item, wanted_.size(), facts);
}

void MissionClient::on_ack(Timestamp now, std::uint8_t result, Voice& voice, Outbox<MissionFact>& facts) {
  if (step_ == Step::uploading) return upload_.on_ack(now, result);
  if (step_ == Step::reading) return download_.on_ack(now, result);
  if (step_ != Step::clearing) return;
  if (result == messages::MAV_MISSION_ACCEPTED) return read_back(now, voice);
  if (result == messages::MAV_MISSION_INVALID_SEQUENCE) return;  // late news of another transfer
  was_valid_ = false;                                            // as this may be, too
  fail_with(now, {.failure = MissionFailure::refused, .result = result, .plan = PlanOnBoard::unchanged}, voice, facts);
}

/// It says which item is current, and how many there are or what the vehicle calls them.
void MissionClient::on_current(Timestamp now, const messages::MissionCurrent& current, Outbox<MissionFact>& facts) {
  if (step_ == Step::setting && current.seq == current_) {
    patience_.measured(now - asked_);
    tell({.kind = MissionFact::Kind::current_set}, facts);
  }
  const std::array<std::uint32_t, plan_types> ids{current.mission_id, current.fence_id, current.rally_points_id};
  for (std::size_t i = 0; i < plan_types; ++i)
    if (ids[i] != 0 && known_[i].opaque_id != 0 && ids[i] != known_[i].opaque_id) known_[i].is_valid = false;
  auto& mission = known_[static_cast<std::size_t>(PlanType::mission)];
  const auto items =
      mission.read.size() - std::min(mission.read.size(), home_items(route_.peer.stack, PlanType::mission));
  constexpr std::uint16_t no_mission = 65535;
  const std::size_t total = current.total == no_mission ? 0 : current.total;
  if (current.total != 0 && total != items) mission.is_valid = false;
}

void MissionClient::note_foreign(std::uint8_t mission_type) {
  for (std::size_t i = 0; i < plan_types; ++i) {
    if (mission_type != i && mission_type < plan_types) continue;
    known_[i].is_valid = false;
    if (static_cast<PlanType>(i) == route_.type) was_valid_ = false;
  }
}

/// Looks whether the transfer has ended.
void MissionClient::go_on(Timestamp now, Voice& voice, Outbox<MissionFact>& facts) {
  if (step_ == Step::uploading && upload_.state() != TransferState::running) on_upload_end(now, voice, facts);
  if (step_ != Step::reading) return;
  if (download_.state() == TransferState::running)
    tell_progress(download_.received(), download_.items().size(), facts);
  else
    on_read(now, voice, facts);
}

void MissionClient::on_upload_end(Timestamp now, Voice& voice, Outbox<MissionFact>& facts) {
  // ArduPilot has overwritten what it has asked for; before that it has cut the plan off, as far as we have been heard.
  const bool is_atomic = route_.peer.stack == Stack::px4;
  const auto plan = is_atomic || !upload_.has_begun() ? PlanOnBoard::unchanged : PlanOnBoard::unknown;
  switch (upload_.state()) {
    case TransferState::refused:
      return fail_with(
          now, {.failure = MissionFailure::refused, .result = upload_.result(), .item = upload_.item(), .plan = plan},
          voice, facts);
    case TransferState::occupied:
      return fail_with(now, {.failure = MissionFailure::occupied, .plan = plan}, voice, facts);
    case TransferState::silent:
      return fail_with(now, {.failure = MissionFailure::silent, .plan = PlanOnBoard::unknown}, voice, facts);
    default: return read_back(now, voice);
  }
}

void MissionClient::on_read(Timestamp now, Voice& voice, Outbox<MissionFact>& facts) {
  if (download_.state() == TransferState::done) return examine(now, voice, facts);
  MissionFact failure{.failure = MissionFailure::unverified, .result = download_.result()};
  if (changes_plan()) failure.plan = PlanOnBoard::unknown;
  if (!changes_plan()) {
    switch (download_.state()) {
      case TransferState::refused: failure.failure = MissionFailure::refused; break;
      case TransferState::occupied: failure.failure = MissionFailure::occupied; break;
      case TransferState::too_many: failure.failure = MissionFailure::too_many; break;
      default: failure.failure = MissionFailure::silent;
    }
  }
  fail_with(now, failure, voice, facts);
}

/// What has been read back, against what was wanted.
void MissionClient::examine(Timestamp now, Voice& voice, Outbox<MissionFact>& facts) {
  const auto& stack = route_.peer.stack;
  if (aim_ != Aim::download) {
    if (const auto item = first_difference(stack, route_.type, wanted_, download_.items())) {
      if (attempts_ < most_attempts) return attempt(now, voice);
      return fail_with(
          now,
          {.failure = MissionFailure::differs, .item = static_cast<std::uint16_t>(*item), .plan = PlanOnBoard::unknown},
          voice, facts);
    }
  }
  const bool is_ours = aim_ != Aim::download;
  known() = {.is_valid = true,
             .read = download_.items(),
             .sent = is_ours ? wanted_ : download_.items(),
             .opaque_id = download_.opaque_id()};
  if (failure_) {
    failure_->plan = PlanOnBoard::restored;
    return tell(*failure_, facts);
  }
  using Kind = MissionFact::Kind;
  tell({.kind = aim_ == Aim::upload ? Kind::uploaded : aim_ == Aim::clear ? Kind::cleared : Kind::downloaded}, facts);
}

/// Puts the plan back that was on board before, if this is known, and the vehicle answers and has another one now.
void MissionClient::fail_with(Timestamp now, MissionFact failure, Voice& voice, Outbox<MissionFact>& facts) {
  failure.kind = MissionFact::Kind::failed;
  if (failure_) return tell(*failure_, facts);  // this was the attempt to put it back
  if (failure.plan == PlanOnBoard::unchanged && changes_plan()) known().is_valid = was_valid_;
  const bool is_heard = failure.failure == MissionFailure::refused || failure.failure == MissionFailure::differs;
  const bool is_worth_it = is_heard && changes_plan() && was_valid_ && failure.plan == PlanOnBoard::unknown;
  if (!is_worth_it) return tell(failure, facts);
  failure_ = failure;
  wanted_ = known().sent;
  attempts_ = 0;
  attempt(now, voice);
}

void MissionClient::tell_progress(std::size_t done, std::size_t total, Outbox<MissionFact>& facts) {
  if (failure_ || done == told_) return;
  told_ = static_cast<std::uint16_t>(done);
  facts.push({.kind = MissionFact::Kind::progress,
              .request = request_,
              .type = route_.type,
              .done = told_,
              .total = static_cast<std::uint16_t>(total)});
}

void MissionClient::tell(MissionFact fact, Outbox<MissionFact>& facts) {
  step_ = Step::idle;
  fact.request = request_;
  fact.type = route_.type;
  facts.push(fact);
}

}  // namespace ponte::autopilot
