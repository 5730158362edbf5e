// The socket and the clock that ponte's services do without: a ground station on a UDP port, for one vehicle that sends
// there, e.g. `ponte sim --endpoint udpout://127.0.0.1:14550`.
#pragma once

#include "ponte/autopilot/dialect.hpp"
#include "ponte/autopilot/fleet_session.hpp"
#include "ponte/autopilot/vehicle_client.hpp"
#include "ponte/mavlink/parser.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>

namespace example {

using ponte::Timestamp;
namespace autopilot = ponte::autopilot;
namespace mavlink = ponte::mavlink;

/// Says why, and ends the program.
[[noreturn]] inline void give_up(std::string_view why) {
  std::fprintf(stderr, "%.*s\n", static_cast<int>(why.size()), why.data());
  std::exit(1);
}

class UdpStation final : private mavlink::FrameSink {
 public:
  explicit UdpStation(std::uint16_t port) : socket_{socket(AF_INET, SOCK_DGRAM, 0)}, parser_{autopilot::dialect} {
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    own.sin_port = htons(port);
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0) give_up("the port is taken");
    session_.on_link_up(now(), link);
  }
  ~UdpStation() { close(socket_); }
  UdpStation(const UdpStation&) = delete;
  UdpStation& operator=(const UdpStation&) = delete;

  /// The vehicle, as soon as it is heard.
  autopilot::VehicleClient& vehicle() {
    while (!client_) step();
    return *client_;
  }
  /// For requests.
  autopilot::Voice voice() { return *session_.voice(link, outgoing_); }
  static Timestamp now() {
    return Timestamp{std::chrono::duration_cast<ponte::Duration>(std::chrono::steady_clock::now().time_since_epoch())};
  }

  /// Begins what `ask` asks the vehicle for, as soon as it can be begun, and waits for what becomes of it.
  template <class Fact, class Ask>
  Fact carry_out(Ask ask) {
    const auto patience_ends = now() + std::chrono::seconds{30};
    auto voice = this->voice();
    auto request = ask(now(), voice);
    for (; !request && now() < patience_ends; request = ask(now(), voice)) step();
    if (!request) give_up("the vehicle does not tell what has to be known of it");
    for (;; step())
      for (; !facts_.empty(); facts_.pop_front())
        if (const auto* fact = std::get_if<Fact>(&facts_.front()))
          if (fact->request == *request && !is_progress(*fact)) return *fact;
  }

  void wait(ponte::Duration duration) {
    for (const auto end = now() + duration; now() < end;) step();
  }
  /// Lets the time go by until there is something to do.
  void step() {
    constexpr int at_most_ms = 20;
    pollfd waiting{.fd = socket_, .events = POLLIN, .revents = 0};
    std::array<std::byte, 2048> buffer{};
    if (poll(&waiting, 1, at_most_ms) > 0) {
      socklen_t length = sizeof vehicle_;
      const auto size =
          recvfrom(socket_, buffer.data(), buffer.size(), 0, reinterpret_cast<sockaddr*>(&vehicle_), &length);
      if (size > 0) parser_.on_datagram(ponte::Bytes{buffer}.first(static_cast<std::size_t>(size)), *this);
    }
    session_.on_tick(now(), outgoing_, fleet_facts_);
    if (client_) {
      auto voice = this->voice();
      client_->on_tick(now(), voice, vehicle_facts_);
    }
    vehicle_facts_.drain([this](const autopilot::VehicleFact& fact) { facts_.push_back(fact); });
    outgoing_.drain([this](const autopilot::OutgoingFrame& frame) {
      if (vehicle_.sin_port == 0) return;  // nobody has been heard yet
      (void)sendto(socket_, frame.bytes().data(), frame.bytes().size(), 0, reinterpret_cast<const sockaddr*>(&vehicle_),
                   sizeof vehicle_);
    });
  }

 private:
  static constexpr autopilot::LinkId link{1};

  template <class Fact>
  static bool is_progress(const Fact& fact) {
    if constexpr (requires { Fact::Kind::progress; }) return fact.kind == Fact::Kind::progress;
    return false;
  }

  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override {
    if (message == nullptr) return;
    (void)session_.on_frame(now(), link, frame, outgoing_, fleet_facts_);
    fleet_facts_.drain([this](const autopilot::FleetFact& fact) {
      if (fact.kind == autopilot::FleetFact::Kind::rebooted) client_->on_reboot(now(), vehicle_facts_);
    });
    if (session_.vehicles().empty()) return;
    const auto& known = session_.vehicles().front();
    if (!client_) client_.emplace(autopilot::Peer{known.system, known.component, known.stack});
    if (known.last_request != streams_asked_) client_->on_streams_asked(known.last_request);
    streams_asked_ = known.last_request;
    auto voice = this->voice();
    client_->on_message(now(), frame, voice, vehicle_facts_);
  }

  int socket_;
  sockaddr_in vehicle_{};
  mavlink::Parser parser_;
  autopilot::FleetSession session_{{}};
  std::optional<autopilot::VehicleClient> client_;
  Timestamp streams_asked_{};
  ponte::Outbox<autopilot::OutgoingFrame> outgoing_{256};
  ponte::Outbox<autopilot::FleetFact> fleet_facts_{16};
  ponte::Outbox<autopilot::VehicleFact> vehicle_facts_{256};
  std::deque<autopilot::VehicleFact> facts_;
};

}  // namespace example
