#include "vehicle/operator.hpp"

#include "common/endpoint_option.hpp"
#include "common/failure.hpp"
#include "common/json_line.hpp"
#include "ponte/autopilot/dialect.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ponte::app {

using autopilot::FleetFact;

Operator::Exchange::Exchange(autopilot::LinkId number, const mavlink::LinkPolicy& policy)
    : id{number}, parser{autopilot::dialect}, guard{policy} {}

Operator::Operator(const OperatorOptions& options)
    : options_{options},
      log_{make_log(options.log)},
      policy_{link_policy_from(options.mavlink)},
      kept_signer_{kept_signer_from(loop_, options.mavlink, log_)},
      session_{{.system = mavlink::SystemId{static_cast<std::uint8_t>(options.own_system)},
                .version = version_from(options.mavlink)}},
      unheard_{mavlink::Version::v2, {}, {}},
      timer_{loop_, [this](Timestamp now) { tick(now); }} {
  auto opened = transport::open_link(loop_, endpoint_from("ENDPOINT", options.endpoint), *this);
  if (!opened) throw Failure{transport::to_text(opened.error())};
  link_ = std::move(*opened);
  loop_.on_signal([this](int) { is_interrupted_ = true; });
  find_vehicle();
}

void Operator::find_vehicle() {
  timer_.set(loop_.now());
  if (run_until([this] { return client_.has_value(); }, patience())) return;
  const auto wanted = options_.system == 0 ? std::string{"no vehicle"} : fmt::format("no vehicle {}", options_.system);
  mavlink::Refusals refused{};
  for (const auto& [peer, exchange] : exchanges_)
    for (std::size_t i = 0; i < refused.size(); ++i) refused[i] += exchange.guard.refused()[i];
  throw Failure{fmt::format("{} was heard on {} within {} s{}", wanted, options_.endpoint, options_.patience_s,
                            refusals_in(refused))};
}

Duration Operator::patience() const {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>{options_.patience_s});
}

bool Operator::run_until(const std::function<bool()>& reached, Duration limit) {
  bool is_reached{};
  const auto is_over = [&] {
    is_reached = reached();
    return is_reached || is_interrupted_ || !trouble_.empty();
  };
  send();
  (void)loop_.run_until(is_over, limit);
  if (is_reached) return true;
  if (is_interrupted_) throw Failure{"interrupted: what was asked of the vehicle last may still be done"};
  if (!trouble_.empty()) throw Failure{trouble_};
  return false;
}

void Operator::run_for(Duration duration) {
  (void)run_until([] { return false; }, duration);
}

void Operator::on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) {
  now_ = now;
  current_ = &exchange_with(now, peer);
  current_->parser.on_bytes(now, bytes, *this);
  send();
}

void Operator::on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) {
  now_ = now;
  current_ = &exchange_with(now, peer);
  current_->parser.on_datagram(bytes, *this);
  send();
}

void Operator::on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view) {
  if (change == transport::PeerChange::joined) {
    (void)exchange_with(now, peer);
  } else if (const auto found = exchanges_.find(peer); found != exchanges_.end()) {
    session_.on_link_down(found->second.id, fleet_facts_);
    exchanges_.erase(found);
  }
  on_fleet_facts();
  send();
}

void Operator::on_state(Timestamp, transport::LinkState state, std::string_view reason) {
  if (state == transport::LinkState::down) log_->warn("{}: {}", options_.endpoint, reason);
}

Operator::Exchange& Operator::exchange_with(Timestamp now, transport::PeerId peer) {
  if (const auto found = exchanges_.find(peer); found != exchanges_.end()) return found->second;
  const autopilot::LinkId number{++last_link_};
  session_.on_link_up(now, number);
  return exchanges_.emplace(std::piecewise_construct, std::tuple{peer}, std::tuple{number, std::cref(policy_)})
      .first->second;
}

void Operator::on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
  if (message == nullptr) return;
  const auto wall = transport::Loop::wall();
  if (const auto refusal = current_->guard.examine(wall, frame, kept_signer_ ? &kept_signer_->signer() : nullptr)) {
    if (current_->guard.refused()[static_cast<std::size_t>(*refusal)] == 1)
      log_->warn("{}: frames are refused: {}", options_.endpoint, name_of(*refusal));
    return;
  }
  const bool is_followed = session_.on_frame(now_, current_->id, frame, frames_, fleet_facts_);
  on_fleet_facts();
  if (!client_) return;
  auto voice = this->voice();
  client_->on_message(now_, frame, voice, vehicle_facts_);
  if (is_followed && frame.system == client_->peer().system) monitor_.on_message(now_, wall, frame, alerts_);
}

const autopilot::FleetSession::Vehicle* Operator::vehicle() const {
  const auto is_meant = [this](const auto& each) {
    return client_ ? each.system == client_->peer().system
                   : options_.system == 0 || each.system.value == options_.system;
  };
  const auto found = std::ranges::find_if(session_.vehicles(), is_meant);
  return found == session_.vehicles().end() ? nullptr : &*found;
}

void Operator::on_fleet_facts() {
  const auto* known = vehicle();
  if (known != nullptr && !client_) client_.emplace(autopilot::Peer{known->system, known->component, known->stack});
  fleet_facts_.drain([&](const FleetFact& fact) {
    if (known == nullptr || fact.system != known->system) return;
    if (fact.kind == FleetFact::Kind::rebooted) client_->on_reboot(now_, vehicle_facts_);
    if (fact.kind == FleetFact::Kind::lost) log_->warn("vehicle {} is not heard any more", fact.system.value);
    if (fact.kind == FleetFact::Kind::returned) log_->info("vehicle {} is heard again", fact.system.value);
    if (fact.kind == FleetFact::Kind::duplicate_id)
      trouble_ = fmt::format("two vehicles use the system id {}: neither is commanded", fact.system.value);
  });
  if (known == nullptr || known->last_request == streams_asked_) return;
  client_->on_streams_asked(known->last_request);
  streams_asked_ = known->last_request;
}

void Operator::tick(Timestamp now) {
  now_ = now;
  for (auto& [peer, exchange] : exchanges_) {
    current_ = &exchange;
    exchange.parser.on_tick(now, *this);
  }
  session_.on_tick(now, frames_, fleet_facts_);
  on_fleet_facts();
  if (client_) {
    auto voice = this->voice();
    client_->on_tick(now, voice, vehicle_facts_);
    monitor_.on_tick(now, transport::Loop::wall(), alerts_);
  }
  send();
}

/// Of a vehicle whose link has ended, the one that it was on; what is said there goes nowhere.
autopilot::Voice Operator::voice() {
  return session_.voice(vehicle()->link, frames_).value_or(autopilot::Voice{unheard_, autopilot::LinkId{}, frames_});
}

void Operator::send() {
  frames_.drain([&](autopilot::OutgoingFrame frame) {
    const auto is_its = [&](const auto& entry) { return entry.second.id == frame.link; };
    const auto found = std::ranges::find_if(exchanges_, is_its);
    if (found == exchanges_.end()) return;
    if (kept_signer_ && frame.buffer[0] == mavlink::start_v2)
      frame.size = kept_signer_->signer().sign(transport::Loop::wall(), 0, frame.buffer, frame.size);
    link_->send_to(found->first, frame.bytes());
  });
  vehicle_facts_.drain([&](const autopilot::VehicleFact& fact) { facts_.push_back(fact); });
  alerts_.drain([&](const vehicle::Alert& alert) { log_->info("vehicle: {}", alert.text.view()); });
  auto deadline = session_.next_deadline();
  const auto consider = [&](std::optional<Timestamp> time) {
    if (time && (!deadline || *time < *deadline)) deadline = time;
  };
  for (const auto& [peer, exchange] : exchanges_) consider(exchange.parser.next_deadline());
  if (client_) {
    consider(client_->next_deadline());
    consider(monitor_.next_deadline());
  }
  timer_.set(deadline);
}

JsonText& Operator::json() { return json_.begin_object().member("vehicle", unsigned{client_->peer().system.value}); }

void Operator::print() {
  json_.end_object();
  print_line(json_);
}

void Operator::tell_done(std::string_view action) {
  if (!options_.json) return fmt::print("{}: done\n", action);
  json().member("action", action).member("result", "done");
  print();
}

void Operator::give_up(std::string_view action, std::string_view code, std::string_view why) {
  if (options_.json) {
    json().member("action", action).member("result", "failed");
    if (!code.empty()) json_.member("code", code);
    json_.member("reason", why);
    print();
  }
  throw Failure{fmt::format("{}: {}{}{}", action, code, code.empty() ? "" : ": ", why)};
}

}  // namespace ponte::app
