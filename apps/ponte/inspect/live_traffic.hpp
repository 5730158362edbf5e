#pragma once

#include "common/capture.hpp"
#include "common/log.hpp"
#include "inspect/dli_traffic.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/loop.hpp"

#include <functional>
#include <map>
#include <memory>

namespace ponte::app {

/// Listens on an endpoint without saying a word, and tells the two languages apart: a datagram that begins as no
/// MAVLink frame does, and as every DLI message does, is one of the DLI. A stream is MAVLink.
class LiveTraffic final : public transport::LinkHandler {
 public:
  using DliVisitor = std::function<void(WallTime time, const dli::WrapperView& message)>;

  /// Frames and damage go to `mavlink`; DLI messages are counted in `dli` and shown to `visitor`. All of these, and
  /// `dialect`, outlive it.
  /// Throws `Failure`.
  LiveTraffic(transport::Loop& loop, const transport::Endpoint& endpoint, Log log, const mavlink::Dialect& dialect,
              CaptureSink& mavlink, DliTraffic& dli, DliVisitor visitor);

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_peer(Timestamp now, transport::PeerId peer, transport::PeerChange change, std::string_view name) override;
  void on_state(Timestamp now, transport::LinkState state, std::string_view reason) override;

 private:
  class Placed;

  mavlink::Parser& parser_of(transport::PeerId peer);
  void wait_for_silence();

  transport::Loop& loop_;
  transport::Endpoint endpoint_;
  Log log_;
  const mavlink::Dialect& dialect_;
  CaptureSink& mavlink_;
  DliTraffic& dli_;
  DliVisitor visitor_;
  std::size_t offset_{};  ///< bytes of MAVLink so far
  std::map<transport::PeerId, std::unique_ptr<mavlink::Parser>> parsers_;
  transport::Timer silence_;
  std::unique_ptr<transport::Link> link_;
};

}  // namespace ponte::app
