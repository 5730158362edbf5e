#pragma once

#include "common/kept_signer.hpp"
#include "common/log.hpp"
#include "common/mavlink_options.hpp"
#include "ponte/autopilot/fleet_session.hpp"
#include "ponte/autopilot/vehicle_client.hpp"
#include "ponte/autopilot/vehicle_monitor.hpp"
#include "ponte/core/json_text.hpp"
#include "ponte/mavlink/link_guard.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/transport/link.hpp"
#include "vehicle/words.hpp"

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace ponte::app {

/// What a command line says of the vehicle, and of how to speak to it.
struct OperatorOptions {
  std::string endpoint;
  unsigned system{};  ///< 0: the first that is heard
  unsigned own_system{250};
  double patience_s{30};  ///< for the vehicle to be heard, and for what it has to know before it can do what is asked
  bool json{};
  MavlinkOptions mavlink;
  LogOptions log;
};

/// A ground station for the time of one job: finds a vehicle on an endpoint, and waits for what its services tell.
class Operator final : private transport::LinkHandler, private mavlink::FrameSink {
 public:
  /// Waits until the vehicle is heard. Throws `Failure`.
  explicit Operator(const OperatorOptions& options);

  [[nodiscard]] autopilot::VehicleClient& client() { return *client_; }
  /// All that is known of the vehicle.
  [[nodiscard]] const vehicle::State& state() const { return monitor_.state(); }
  [[nodiscard]] Timestamp now() const { return loop_.now(); }
  [[nodiscard]] bool wants_json() const { return options_.json; }

  /// Runs until `reached`, which is asked after every event; false if the limit comes first. Throws `Failure` when the
  /// vehicle is lost, or the user wants no more.
  bool run_until(const std::function<bool()>& reached, Duration limit);
  void run_for(Duration duration);

  /// Begins what `begin(voice)` begins, as soon as the vehicle is known well enough (`is_early(error)` says whether it
  /// is not). Throws `Failure` with the words for its error.
  template <class Begin, class IsEarly>
  auto begin(std::string_view action, Begin&& begin, IsEarly&& is_early) {
    auto started = begin(voice());
    const auto try_again = [&] {
      if (!started && is_early(started.error())) started = begin(voice());
      return started || !is_early(started.error());
    };
    (void)run_until(try_again, patience());
    if (!started) give_up(action, "", to_text(started.error()));
    return started;
  }

  /// The next fact of this type that has come; those before it are passed over.
  template <class Fact>
  std::optional<Fact> next() {
    std::optional<Fact> found;
    for (; !facts_.empty() && !found; facts_.pop_front())
      if (const auto* fact = std::get_if<Fact>(&facts_.front())) found = *fact;
    return found;
  }

  /// Waits for the fact of this type that `is_it`; `meanwhile` sees those that are not.
  template <class Fact, class IsIt, class Meanwhile>
  Fact await(IsIt&& is_it, Meanwhile&& meanwhile) {
    std::optional<Fact> found;
    const auto look = [&] {
      while ((found = next<Fact>()) && !is_it(*found)) meanwhile(*found);
      return found.has_value();
    };
    while (!run_until(look, std::chrono::hours{1})) {
    }
    return *found;
  }

  /// Tells the user that it is done.
  void tell_done(std::string_view action);
  /// Tells him that it is not, and throws `Failure`.
  [[noreturn]] void give_up(std::string_view action, std::string_view code, std::string_view why);
  /// A line of JSON that names the vehicle and is closed by `print`.
  [[nodiscard]] JsonText& json();
  void print();

 private:
  /// One peer of the endpoint.
  struct Exchange {
    Exchange(autopilot::LinkId number, const mavlink::LinkPolicy& policy);
    autopilot::LinkId id;
    mavlink::Parser parser;
    mavlink::LinkGuard guard;
  };

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view name) override;
  void on_state(Timestamp now, transport::LinkState state, std::string_view reason) override;
  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;

  Exchange& exchange_with(Timestamp now, transport::PeerId peer);
  void on_fleet_facts();
  void find_vehicle();
  [[nodiscard]] const autopilot::FleetSession::Vehicle* vehicle() const;
  void tick(Timestamp now);
  void send();
  [[nodiscard]] autopilot::Voice voice();
  [[nodiscard]] Duration patience() const;

  OperatorOptions options_;
  Log log_;
  transport::Loop loop_;
  mavlink::LinkPolicy policy_;
  std::unique_ptr<KeptSigner> kept_signer_;
  autopilot::FleetSession session_;
  std::optional<autopilot::VehicleClient> client_;
  autopilot::VehicleMonitor monitor_;
  std::map<transport::PeerId, Exchange> exchanges_;
  std::uint16_t last_link_{};
  Exchange* current_{};  // while its bytes are read
  Timestamp now_{};
  Timestamp streams_asked_{};
  bool is_interrupted_{};
  std::string trouble_;  // why the job cannot go on
  Outbox<autopilot::OutgoingFrame> frames_{256};
  Outbox<autopilot::FleetFact> fleet_facts_{16};
  Outbox<autopilot::VehicleFact> vehicle_facts_{256};
  Outbox<vehicle::Alert> alerts_{16};
  std::deque<autopilot::VehicleFact> facts_;
  mavlink::FrameSender unheard_;  // speaks where no link is
  JsonText json_;
  std::unique_ptr<transport::Link> link_;
  transport::Timer timer_;
};

}  // namespace ponte::app
