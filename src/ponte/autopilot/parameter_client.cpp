#include "ponte/autopilot/parameter_client.hpp"

#include "ponte/mavlink/autopilots/param_request_list.hpp"
#include "ponte/mavlink/autopilots/param_request_read.hpp"
#include "ponte/mavlink/autopilots/param_set.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ponte::autopilot {

namespace messages = mavlink::autopilots;

ParameterClient::ParameterClient(const Peer& peer, const ParameterTimes& times)
    : peer_{peer}, times_{times}, patience_{times.patience} {
  wanted_.reserve(window);
}

std::vector<Parameter> ParameterClient::known() const {
  std::vector<Parameter> result;
  for (const auto* entries : {&entries_, &others_})
    for (const auto& each : *entries)
      if (each.is_known) result.push_back(each.parameter);
  return result;
}

const Parameter* ParameterClient::find(std::string_view name) const {
  for (const auto* entries : {&entries_, &others_})
    for (const auto& each : *entries)
      if (each.is_known && each.parameter.name.view() == name) return &each.parameter;
  return nullptr;
}

void ParameterClient::take_over(std::vector<Parameter> all) {
  entries_.clear();
  others_.clear();
  for (auto& each : all) entries_.push_back({.is_known = true, .parameter = std::move(each)});
  known_ = entries_.size();
  is_complete_ = true;
  hash_.reset();
}

void ParameterClient::on_reboot() {
  is_complete_ = false;
  hash_.reset();
}

// Requests.

std::optional<ParameterRefusal> ParameterClient::reason_not_to(const Voice& voice) const {
  if (voice.version() == mavlink::Version::v0_9) return ParameterRefusal::not_in_mavlink_09;
  if (is_busy()) return ParameterRefusal::busy;
  return std::nullopt;
}

ParameterRequestId ParameterClient::begin(Timestamp now) {
  began_ = heard_ = now;
  end_ = now + times_.silence_limit;
  is_repeated_ = false;
  answers_ = 0;
  wanted_.clear();
  return request_ = ParameterRequestId{request_.value + 1};
}

Result<ParameterRequestId, ParameterRefusal> ParameterClient::fetch_all(Timestamp now, Voice& voice) {
  if (const auto reason = reason_not_to(voice)) return fail(*reason);
  begin(now);
  if (is_complete_ && hash_) {
    step_ = Step::comparing;
    ask(now, voice);
  } else {
    list(now, voice);
  }
  return request_;
}

Result<ParameterRequestId, ParameterRefusal> ParameterClient::get(Timestamp now, std::string_view name, Voice& voice) {
  if (const auto reason = reason_not_to(voice)) return fail(*reason);
  if (name.empty() || name.size() > ParameterName::capacity) return fail(ParameterRefusal::bad_name);
  begin(now);
  target_ = {.name = name};
  is_set_ = false;
  step_ = Step::reading;
  ask(now, voice);
  return request_;
}

Result<ParameterRequestId, ParameterRefusal> ParameterClient::set(Timestamp now, std::string_view name, double value,
                                                                  Voice& voice) {
  if (const auto reason = reason_not_to(voice)) return fail(*reason);
  if (name.empty() || name.size() > ParameterName::capacity) return fail(ParameterRefusal::bad_name);
  const auto* known = find(name);
  if (!std::isfinite(value) || (known != nullptr && !is_value_of(known->type, value)))
    return fail(ParameterRefusal::bad_value);
  begin(now);
  target_ = {.name = name, .value = value};
  is_set_ = true;
  if (known != nullptr) target_.type = known->type;
  step_ = known != nullptr ? Step::setting : Step::reading;
  ask(now, voice);
  return request_;
}

// What is sent.

void ParameterClient::list(Timestamp now, Voice& voice) {
  step_ = Step::listing;
  entries_.clear();
  others_.clear();
  known_ = next_ = 0;
  is_complete_ = false;
  hash_.reset();
  new_hash_.reset();
  voice.send(
      messages::ParamRequestList{.target_system = peer_.system.value, .target_component = peer_.component.value});
  next_try_ = now + std::max(times_.list_pause, patience_.current());
}

void ParameterClient::read(std::string_view name, std::int16_t index, Voice& voice) const {
  voice.send(messages::ParamRequestRead{.target_system = peer_.system.value,
                                        .target_component = peer_.component.value,
                                        .param_id = name,
                                        .param_index = index});
}

void ParameterClient::write(Voice& voice) const {
  voice.send(messages::ParamSet{.target_system = peer_.system.value,
                                .target_component = peer_.component.value,
                                .param_id = target_.name,
                                .param_value = encode_parameter(peer_.stack, target_.type, target_.value),
                                .param_type = static_cast<std::uint8_t>(target_.type)});
}

/// For the one that the request, or this step of it, is about. An autopilot need not tell what it has been set to: it
/// is asked, the second time.
void ParameterClient::ask(Timestamp now, Voice& voice) {
  if (step_ == Step::setting) write(voice);
  if (step_ != Step::setting || is_repeated_)
    read(step_ == Step::comparing ? hash_name : target_.name.view(), -1, voice);
  asked_ = now;
  next_try_ = now + patience_.current();
}

/// Asks for what is missing of the list, as far as there is room.
void ParameterClient::fill(Timestamp now, Voice& voice) {
  for (; wanted_.size() < window && next_ < entries_.size(); ++next_) {
    if (entries_[next_].is_known) continue;
    wanted_.push_back({.index = static_cast<std::uint16_t>(next_), .asked = now});
    read({}, static_cast<std::int16_t>(next_), voice);
  }
}

void ParameterClient::on_tick(Timestamp now, Voice& voice, Outbox<ParameterFact>& facts) {
  if (!is_busy() || now < *next_deadline()) return;
  if (now >= end_ || now - heard_ >= times_.silence_limit) {
    const auto failure = answers_ > 0 ? ParameterFailure::differs : ParameterFailure::silent;
    const auto* known = find(target_.name.view());
    return tell(
        {.kind = ParameterFact::Kind::failed, .parameter = known != nullptr ? *known : target_, .failure = failure},
        facts);
  }
  switch (step_) {
    case Step::idle: return;
    case Step::listing:
      if (known_ == 0) {
        patience_.ran_out();
        return list(now, voice);
      }
      step_ = Step::filling;
      return fill(now, voice);
    case Step::filling:
      for (auto& wanted : wanted_) {
        if (now - wanted.asked < patience_.current()) continue;
        wanted.asked = now;
        wanted.is_repeated = true;
        read({}, static_cast<std::int16_t>(wanted.index), voice);
      }
      return patience_.ran_out();
    case Step::comparing:
    case Step::reading:
    case Step::setting: break;
  }
  patience_.ran_out();
  is_repeated_ = true;
  ask(now, voice);
}

std::optional<Timestamp> ParameterClient::next_deadline() const {
  if (!is_busy()) return std::nullopt;
  auto next = std::min(end_, heard_ + times_.silence_limit);
  if (step_ != Step::filling) return std::min(next, next_try_);
  for (const auto& wanted : wanted_) next = std::min(next, wanted.asked + patience_.current());
  return next;
}

}  // namespace ponte::autopilot
