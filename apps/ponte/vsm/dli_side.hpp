#pragma once

#include "ponte/dli/datagram.hpp"
#include "ponte/transport/link.hpp"
#include "vsm/live_vsm.hpp"

#include <set>
#include <string>

namespace ponte::app {

/// One endpoint of the DLI. What stations say is counted and not obeyed, which the log says once of each: every station
/// is monitor only.
class DliSide final : public transport::LinkHandler {
 public:
  /// Throws `Failure`. The owner outlives it.
  DliSide(LiveVsm& owner, const transport::Endpoint& endpoint);

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_datagram(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_state(Timestamp now, transport::LinkState state, std::string_view reason) override;

  void send(Bytes message) { link_->send(message); }
  [[nodiscard]] const std::string& name() const { return name_; }
  void log_counters() const;

 private:
  static constexpr std::size_t refusals_told = 64;

  void refuse(const dli::WrapperView& message);

  LiveVsm& owner_;
  transport::Endpoint endpoint_;
  std::string name_;
  dli::DatagramCounters heard_;
  std::set<dli::EntityId> refused_;  ///< stations that the log has told of
  std::unique_ptr<transport::Link> link_;
};

}  // namespace ponte::app
