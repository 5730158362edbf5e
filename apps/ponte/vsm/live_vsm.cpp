#include "vsm/live_vsm.hpp"

#include "common/failure.hpp"

#include <fmt/format.h>

#include <map>

namespace ponte::app {
namespace {

std::string_view name_of(autopilot::FleetFact::Kind kind) {
  using enum autopilot::FleetFact::Kind;
  switch (kind) {
    case appeared: return "vehicle appeared";
    case lost: return "vehicle lost";
    case returned: return "vehicle returned";
    case rebooted: return "vehicle rebooted";
    case duplicate_id: return "two vehicles use one id, the second is left out";
  }
  return "";
}

}  // namespace

/// One endpoint with vehicles: each of its peers is a link of its own to the bridge.
class LiveVsm::VehicleSide final : public transport::LinkHandler {
 public:
  VehicleSide(LiveVsm& owner, const transport::Endpoint& endpoint)
      : owner_{owner}, name_{transport::to_text(endpoint)} {
    auto opened = transport::open_link(owner.loop_, endpoint, *this);
    if (!opened) throw Failure{transport::to_text(opened.error())};
    link_ = std::move(*opened);
  }

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override {
    owner_.bridge_.on_bytes(now, transport::Loop::wall(), number_of(now, peer), bytes);
    owner_.pump();
  }
  void on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) override {
    owner_.bridge_.on_datagram(now, transport::Loop::wall(), number_of(now, peer), bytes);
    owner_.pump();
  }
  void on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view name) override {
    if (change == transport::PeerChange::joined) {
      owner_.log_->info("{} joined {}", name, name_);
      (void)number_of(now, peer);
    } else if (const auto found = numbers_.find(peer); found != numbers_.end()) {
      owner_.log_->info("{} left {}", name, name_);
      owner_.bridge_.on_link_down(now, transport::Loop::wall(), found->second);
      numbers_.erase(found);
    }
    owner_.pump();
  }
  void on_state(Timestamp, transport::LinkState state, std::string_view reason) override {
    if (state == transport::LinkState::down)
      owner_.log_->warn("{} is down: {}", name_, reason);
    else
      owner_.log_->info("{} is {}", name_, transport::name_of(state));
  }

  /// True when the link is one of ours; the frame is on its way then.
  bool send(const autopilot::OutgoingFrame& frame) {
    for (const auto& [peer, number] : numbers_) {
      if (number != frame.link) continue;
      link_->send_to(peer, frame.bytes());
      return true;
    }
    return false;
  }

 private:
  autopilot::LinkId number_of(Timestamp now, transport::PeerId peer) {
    const auto found = numbers_.find(peer);
    if (found != numbers_.end()) return found->second;
    const autopilot::LinkId number{owner_.next_link_++};
    numbers_.emplace(peer, number);
    owner_.bridge_.on_link_up(now, number);
    return number;
  }

  LiveVsm& owner_;
  std::string name_;
  std::map<transport::PeerId, autopilot::LinkId> numbers_;
  std::unique_ptr<transport::Link> link_;
};

/// One endpoint of the DLI. What stations say is not listened to yet: every station is monitor only.
class LiveVsm::DliSide final : public transport::LinkHandler {
 public:
  DliSide(LiveVsm& owner, const transport::Endpoint& endpoint) : owner_{owner}, name_{transport::to_text(endpoint)} {
    auto opened = transport::open_link(owner.loop_, endpoint, *this);
    if (!opened) throw Failure{transport::to_text(opened.error())};
    link_ = std::move(*opened);
  }

  void on_bytes(Timestamp, Bytes, transport::PeerId) override {}
  void on_datagram(Timestamp, Bytes, transport::PeerId) override {}
  void on_state(Timestamp, transport::LinkState state, std::string_view reason) override {
    if (state == transport::LinkState::down)
      owner_.log_->warn("{} is down: {}", name_, reason);
    else
      owner_.log_->info("{} is {}", name_, transport::name_of(state));
  }

  void send(Bytes message) { link_->send(message); }

 private:
  LiveVsm& owner_;
  std::string name_;
  std::unique_ptr<transport::Link> link_;
};

LiveVsm::LiveVsm(transport::Loop& loop, const vsm::BridgeConfig& config, Log log)
    : loop_{loop}, bridge_{config}, log_{std::move(log)}, timer_{loop, [this](Timestamp now) {
                                                                   bridge_.on_tick(now, transport::Loop::wall());
                                                                   pump();
                                                                 }} {
  timer_.set(loop.now());
}
LiveVsm::~LiveVsm() = default;

void LiveVsm::add_vehicle(const transport::Endpoint& endpoint) {
  vehicle_sides_.push_back(std::make_unique<VehicleSide>(*this, endpoint));
}

void LiveVsm::add_dli(const transport::Endpoint& endpoint) {
  dli_sides_.push_back(std::make_unique<DliSide>(*this, endpoint));
}

/// Carries out what the bridge wants done.
void LiveVsm::pump() {
  bridge_.messages.drain([&](const vsm::OutgoingMessage& message) {
    for (const auto& side : dli_sides_) side->send(message.bytes());
    if (observer_) observer_(message);
  });
  bridge_.frames.drain([&](const autopilot::OutgoingFrame& frame) {
    for (const auto& side : vehicle_sides_)
      if (side->send(frame)) break;
  });
  bridge_.facts.drain([&](const autopilot::FleetFact& fact) { log_fact(fact); });
  timer_.set(bridge_.next_deadline());
}

void LiveVsm::log_fact(const autopilot::FleetFact& fact) {
  using Kind = autopilot::FleetFact::Kind;
  const bool is_bad = fact.kind == Kind::lost || fact.kind == Kind::duplicate_id;
  log_->log(is_bad ? spdlog::level::warn : spdlog::level::info, "{} sysid={} compid={} link={}", name_of(fact.kind),
            fact.system.value, fact.component.value, fact.link.value);
}

}  // namespace ponte::app
