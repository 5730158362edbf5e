#pragma once

#include "ponte/mavlink/parser.hpp"
#include "route/live_router.hpp"

#include <map>
#include <memory>
#include <string>

namespace ponte::app {

/// One endpoint of a router.
class RouteSide final : public transport::LinkHandler, private mavlink::FrameSink {
 public:
  /// Throws `Failure`. The owner outlives it.
  RouteSide(LiveRouter& owner, const transport::Endpoint& endpoint, mavlink::RouteRules rules);

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view name) override;
  void on_state(Timestamp now, transport::LinkState state, std::string_view reason) override;

  void send(transport::PeerId peer, Bytes frame) { link_->send_to(peer, frame); }
  /// Passes on what peers have said so far, and tells the router that they are gone: the endpoint is about to be
  /// closed.
  void end_all(Timestamp now);
  [[nodiscard]] const transport::Endpoint& endpoint() const { return endpoint_; }
  /// The endpoint in the shortest words.
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool is_untrusted() const { return rules_.untrusted; }
  [[nodiscard]] transport::LinkState state() const { return link_->state(); }
  [[nodiscard]] std::size_t peer_count() const { return peers_.size(); }
  void print_json() const;
  void log_counters() const;

 private:
  struct Peer {
    explicit Peer(mavlink::RouteLinkId number);

    mavlink::RouteLinkId id;
    mavlink::Parser parser;
    std::string name;
  };

  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;

  /// All members of a multicast group are one.
  [[nodiscard]] transport::PeerId key_of(transport::PeerId peer) const;
  /// Makes `peer` the one that is read; false if there was no room for it.
  bool enter(Timestamp now, transport::PeerId peer);
  void end(Timestamp now, transport::PeerId peer);
  void wait_for_silence();

  LiveRouter& owner_;
  transport::Endpoint endpoint_;
  std::string name_;
  mavlink::RouteRules rules_;
  std::map<transport::PeerId, std::unique_ptr<Peer>> peers_;
  // While a peer is read.
  Timestamp now_{};
  Peer* current_{};
  transport::Timer silence_;
  std::unique_ptr<transport::Link> link_;
};

}  // namespace ponte::app
