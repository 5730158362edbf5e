#include "ponte/autopilot/mission_client.hpp"

#include "ponte/autopilot/kept_plan.hpp"
#include "ponte/mavlink/autopilots/mission_clear_all.hpp"
#include "ponte/mavlink/autopilots/mission_set_current.hpp"

#include <algorithm>
#include <utility>

namespace ponte::autopilot {

namespace messages = mavlink::autopilots;

MissionClient::MissionClient(const Peer& peer, const TransferTimes& times)
    : route_{.peer = peer, .type = {}},
      times_{times},
      patience_{times.patience},
      upload_{times, patience_},
      download_{times, patience_} {}

const std::vector<WireItem>* MissionClient::plan(PlanType type) const {
  const auto& known = known_[static_cast<std::size_t>(type)];
  return known.is_valid ? &known.read : nullptr;
}

// Requests.

std::optional<MissionRefusal> MissionClient::reason_not_to(PlanType type, const Voice& voice) const {
  if (voice.version() == mavlink::Version::v0_9) return MissionRefusal::not_in_mavlink_09;
  if (voice.version() == mavlink::Version::v1 && type != PlanType::mission) return MissionRefusal::needs_mavlink_2;
  if (is_busy()) return MissionRefusal::busy;
  return std::nullopt;
}

MissionRequestId MissionClient::begin(Aim aim, PlanType type) {
  aim_ = aim;
  route_.type = type;
  attempts_ = 0;
  was_valid_ = known().is_valid;
  told_ = 0;
  failure_.reset();
  return request_ = MissionRequestId{request_.value + 1};
}

Result<MissionRequestId, MissionRefusal> MissionClient::upload(Timestamp now, PlanType type,
                                                               std::vector<WireItem> items, Voice& voice) {
  if (const auto reason = reason_not_to(type, voice)) return fail(*reason);
  if (items.size() > PlanDownload::item_limit) return fail(MissionRefusal::too_many_items);
  begin(Aim::upload, type);
  wanted_ = std::move(items);
  if (known().is_valid && (is_same_plan(wanted_, known().sent) || is_same_plan(wanted_, known().read))) {
    step_ = Step::telling;
    next_try_ = now;
  } else {
    attempt(now, voice);
  }
  return request_;
}

Result<MissionRequestId, MissionRefusal> MissionClient::confirm(Timestamp now, PlanType type,
                                                                std::vector<WireItem> items, Voice& voice) {
  if (const auto reason = reason_not_to(type, voice)) return fail(*reason);
  if (items.size() > PlanDownload::item_limit) return fail(MissionRefusal::too_many_items);
  begin(Aim::upload, type);
  was_valid_ = known().is_valid = false;
  wanted_ = std::move(items);
  upload_.forget();
  read_back(now, voice);
  return request_;
}

Result<MissionRequestId, MissionRefusal> MissionClient::download(Timestamp now, PlanType type, Voice& voice) {
  if (const auto reason = reason_not_to(type, voice)) return fail(*reason);
  begin(Aim::download, type);
  read_back(now, voice);
  return request_;
}

Result<MissionRequestId, MissionRefusal> MissionClient::clear(Timestamp now, PlanType type, Voice& voice) {
  if (const auto reason = reason_not_to(type, voice)) return fail(*reason);
  begin(Aim::clear, type);
  wanted_.clear();
  attempt(now, voice);
  return request_;
}

Result<MissionRequestId, MissionRefusal> MissionClient::set_current(Timestamp now, std::uint16_t item, Voice& voice) {
  if (const auto reason = reason_not_to(PlanType::mission, voice)) return fail(*reason);
  begin(Aim::set_current, PlanType::mission);
  current_ = item;
  step_ = Step::setting;
  since_ = now;
  send_request(now, voice);
  return request_;
}

// What they come to.

/// Sends what is wanted, or clears what is there.
void MissionClient::attempt(Timestamp now, Voice& voice) {
  ++attempts_;
  known().is_valid = false;
  if (aim_ == Aim::clear && !failure_) {
    step_ = Step::clearing;
    since_ = now;
    return send_request(now, voice);
  }
  step_ = Step::uploading;
  upload_.begin(now, route_, wanted_, voice);
}

void MissionClient::read_back(Timestamp now, Voice& voice) {
  step_ = Step::reading;
  download_.begin(now, route_, voice);
}

void MissionClient::send_request(Timestamp now, Voice& voice) {
  const auto& peer = route_.peer;
  asked_ = now;
  next_try_ = now + patience_.current();
  if (step_ == Step::clearing)
    voice.send(messages::MissionClearAll{.target_system = peer.system.value,
                                         .target_component = peer.component.value,
                                         .mission_type = static_cast<std::uint8_t>(route_.type)});
  else
    voice.send(messages::MissionSetCurrent{
        .target_system = peer.system.value, .target_component = peer.component.value, .seq = current_});
}

void MissionClient::repeat(Timestamp now, Voice& voice, Outbox<MissionFact>& facts) {
  if (now < next_try_) return;
  if (now - since_ >= times_.silence_limit)
    return fail_with(now, {.failure = MissionFailure::silent, .plan = PlanOnBoard::unknown}, voice, facts);
  patience_.ran_out();
  send_request(now, voice);
}

void MissionClient::on_tick(Timestamp now, Voice& voice, Outbox<MissionFact>& facts) {
  switch (step_) {
    case Step::idle: return;
    case Step::telling: return tell({.kind = MissionFact::Kind::uploaded, .was_on_board = true}, facts);
    case Step::beginning_anew: return begin_anew(now, voice, facts);
    case Step::uploading: upload_.on_tick(now, voice); break;
    case Step::reading: download_.on_tick(now, voice); break;
    case Step::clearing:
    case Step::setting: return repeat(now, voice, facts);
  }
  go_on(now, voice, facts);
}

std::optional<Timestamp> MissionClient::next_deadline() const {
  switch (step_) {
    case Step::idle: return std::nullopt;
    case Step::uploading: return upload_.next_deadline();
    case Step::reading: return download_.next_deadline();
    case Step::telling:
    case Step::beginning_anew:
    case Step::clearing:
    case Step::setting: break;
  }
  return next_try_;
}

void MissionClient::on_reboot(Timestamp now) {
  for (auto& each : known_) each.is_valid = false;
  was_valid_ = false;
  if (step_ != Step::uploading && step_ != Step::reading) return;
  step_ = Step::beginning_anew;
  next_try_ = now;
}

void MissionClient::begin_anew(Timestamp now, Voice& voice, Outbox<MissionFact>& facts) {
  if (!changes_plan()) return read_back(now, voice);
  if (attempts_ < most_attempts) return attempt(now, voice);
  fail_with(now, {.failure = MissionFailure::silent, .plan = PlanOnBoard::unknown}, voice, facts);
}

}  // namespace ponte::autopilot
