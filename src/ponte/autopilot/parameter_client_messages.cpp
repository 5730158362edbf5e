#include "ponte/autopilot/parameter_client.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>
#include <bit>

namespace ponte::autopilot {

namespace messages = mavlink::autopilots;

namespace {

/// Different values that are answered before a vehicle is believed to want no other; the first may be late news.
constexpr int most_answers = 3;

}  // namespace

void ParameterClient::on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice,
                                 Outbox<ParameterFact>& facts) {
  if (frame.version == mavlink::Version::v0_9) return;
  if (frame.system != peer_.system || frame.component != peer_.component) return;
  if (frame.message == messages::ParamValue::info.id)
    on_value(now, mavlink::decode<messages::ParamValue>(frame), voice, facts);
  else if (frame.message == messages::ParamError::info.id)
    on_error(mavlink::decode<messages::ParamError>(frame), voice, facts);
}

/// The vehicle tells values to everybody, asked or unasked: what is told is kept, and may be what is waited for.
void ParameterClient::on_value(Timestamp now, const messages::ParamValue& value, Voice& voice,
                               Outbox<ParameterFact>& facts) {
  if (value.param_id.view() == hash_name)
    return on_hash(now, std::bit_cast<std::uint32_t>(value.param_value), voice, facts);
  const auto type = parameter_type(value.param_type);
  if (!type || value.param_id.empty()) return;
  const Parameter parameter{
      .name = value.param_id, .type = *type, .value = decode_parameter(peer_.stack, *type, value.param_value)};
  keep(parameter, value.param_index, value.param_count);
  switch (step_) {
    case Step::listing:
    case Step::filling:
      if (value.param_index < value.param_count) on_listed(now, value.param_index, voice, facts);
      return;
    case Step::reading:
    case Step::setting:
      if (parameter.name == target_.name) on_wanted(now, parameter, voice, facts);
      return;
    case Step::idle:
    case Step::comparing: return;
  }
}

/// A list whose length has changed is another one: what was at its places may be elsewhere now.
void ParameterClient::keep(const Parameter& parameter, std::uint16_t index, std::uint16_t count) {
  const auto is_it = [&](const Entry& each) { return each.is_known && each.parameter.name == parameter.name; };
  const bool is_fetching = step_ == Step::listing || step_ == Step::filling;
  if (index < count && is_fetching) {
    if (entries_.size() != count) {
      entries_.assign(count, Entry{});
      known_ = next_ = 0;
      wanted_.clear();
      end_ = began_ + times_.silence_limit + count * times_.per_parameter;
    }
    auto& entry = entries_[index];
    if (!entry.is_known) ++known_;
    entry = {.is_known = true, .parameter = parameter};
    std::erase_if(others_, is_it);
    return;
  }
  for (auto* entries : {&entries_, &others_}) {
    if (const auto found = std::ranges::find_if(*entries, is_it); found != entries->end()) {
      found->parameter = parameter;
      return;
    }
  }
  constexpr std::size_t most_others = 1000;
  if (others_.size() < most_others) others_.push_back({.is_known = true, .parameter = parameter});
}

void ParameterClient::on_hash(Timestamp now, std::uint32_t hash, Voice& voice, Outbox<ParameterFact>& facts) {
  heard_ = now;
  if (step_ == Step::listing && known_ == 0) new_hash_ = hash;
  if (step_ != Step::comparing) return;
  if (!is_repeated_) patience_.measured(now - asked_);
  if (hash_ != hash) return list(now, voice);
  tell({.kind = ParameterFact::Kind::fetched, .total = static_cast<std::uint16_t>(known_), .was_known = true}, facts);
}

void ParameterClient::on_listed(Timestamp now, std::uint16_t index, Voice& voice, Outbox<ParameterFact>& facts) {
  heard_ = now;
  next_try_ = now + times_.list_pause;
  if (const auto found = std::ranges::find(wanted_, index, &Wanted::index); found != wanted_.end()) {
    if (!found->is_repeated) patience_.measured(now - found->asked);
    wanted_.erase(found);
  }
  const auto total = static_cast<std::uint16_t>(entries_.size());
  if (known_ == entries_.size()) {
    is_complete_ = true;
    hash_ = new_hash_;
    return tell({.kind = ParameterFact::Kind::fetched, .total = total}, facts);
  }
  facts.push({.kind = ParameterFact::Kind::progress,
              .request = request_,
              .done = static_cast<std::uint16_t>(known_),
              .total = total});
  if (step_ == Step::filling) fill(now, voice);
}

void ParameterClient::on_wanted(Timestamp now, const Parameter& parameter, Voice& voice, Outbox<ParameterFact>& facts) {
  using Kind = ParameterFact::Kind;
  heard_ = now;
  if (!is_repeated_) patience_.measured(now - asked_);
  if (step_ == Step::reading && !is_set_) return tell({.kind = Kind::got, .parameter = parameter}, facts);
  if (step_ == Step::reading) {
    target_.type = parameter.type;
    if (!is_value_of(target_.type, target_.value))
      return tell({.kind = Kind::failed, .parameter = parameter, .failure = ParameterFailure::bad_value}, facts);
    step_ = Step::setting;
    is_repeated_ = false;
    return ask(now, voice);
  }
  // What was believed of its type was wrong if the vehicle tells another one.
  if (is_value_of(parameter.type, target_.value)) target_.type = parameter.type;
  const float wire = encode_parameter(peer_.stack, target_.type, target_.value);
  if (parameter.value == decode_parameter(peer_.stack, target_.type, wire))
    return tell({.kind = Kind::set, .parameter = parameter}, facts);
  if (is_repeated_ && ++answers_ >= most_answers)
    tell({.kind = Kind::failed, .parameter = parameter, .failure = ParameterFailure::differs}, facts);
}

void ParameterClient::on_error(const messages::ParamError& error, const Voice& voice, Outbox<ParameterFact>& facts) {
  const bool is_ours = voice.is_addressed(error.target_system, error.target_component);
  const bool is_about_it = (step_ == Step::reading || step_ == Step::setting) && error.param_id == target_.name;
  if (!is_ours || !is_about_it) return;
  tell({.kind = ParameterFact::Kind::failed,
        .parameter = target_,
        .failure = ParameterFailure::refused,
        .error = error.error},
       facts);
}

void ParameterClient::tell(ParameterFact fact, Outbox<ParameterFact>& facts) {
  step_ = Step::idle;
  wanted_.clear();
  fact.request = request_;
  facts.push(fact);
}

}  // namespace ponte::autopilot
