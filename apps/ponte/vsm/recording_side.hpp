#pragma once

#include "common/recorded_vsm.hpp"
#include "common/recording.hpp"
#include "ponte/transport/replay.hpp"
#include "vsm/live_vsm.hpp"

#include <string>

namespace ponte::app {

/// A recording in place of vehicles. It is replayed at its pace and translated in its own time, so that the DLI
/// messages are those of `ponte translate`.
class RecordingSide final : public transport::LinkHandler {
 public:
  /// Throws `Failure`. The owner outlives it.
  RecordingSide(LiveVsm& owner, const transport::FileEndpoint& endpoint);

  void on_bytes(Timestamp now, Bytes bytes, transport::PeerId peer) override;
  void on_datagram(Timestamp now, Bytes frame, transport::PeerId peer) override;
  void on_state(Timestamp now, transport::LinkState state, std::string_view reason) override;

  [[nodiscard]] bool is_finished() const { return is_finished_; }
  void log_counters() const;

 private:
  LiveVsm& owner_;
  std::string name_;
  Recording recording_;
  RecordedVsm vsm_;
  std::uint64_t frames_{};
  bool is_finished_{};
  transport::Replay replay_;
};

}  // namespace ponte::app
