#pragma once

#include "common/failure.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/loop.hpp"

#include <functional>
#include <memory>
#include <utility>

namespace ponte::app {

/// A ground station on a UDP port of this machine that only listens.
class LocalStation final : public transport::LinkHandler {
 public:
  using Listener = std::function<void(Bytes datagram)>;

  /// Throws `Failure`.
  explicit LocalStation(
      transport::Loop& loop, Listener listener = [](Bytes) {})
      : listener_{std::move(listener)} {
    auto opened = transport::open_link(loop, transport::UdpInEndpoint{{"127.0.0.1", 0}}, *this);
    if (!opened) throw Failure{transport::to_text(opened.error())};
    link_ = std::move(*opened);
  }

  /// Where it hears what is sent.
  [[nodiscard]] transport::Endpoint place() const {
    return transport::UdpOutEndpoint{{"127.0.0.1", link_->local_port()}};
  }

  void on_bytes(Timestamp, Bytes bytes, transport::PeerId) override { listener_(bytes); }
  void on_datagram(Timestamp, Bytes datagram, transport::PeerId) override { listener_(datagram); }
  void on_state(Timestamp, transport::LinkState, std::string_view) override {}

 private:
  Listener listener_;
  std::unique_ptr<transport::Link> link_;
};

}  // namespace ponte::app
