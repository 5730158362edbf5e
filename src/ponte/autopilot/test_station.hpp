#pragma once

#include "ponte/autopilot/peer.hpp"
#include "ponte/autopilot/test_frames.hpp"
#include "ponte/autopilot/voice.hpp"

#include <chrono>
#include <vector>

/// For the tests of the services in this folder.
namespace ponte::autopilot::testing {

inline constexpr Timestamp start{std::chrono::hours{1}};

/// The station that a client speaks for, and all that it has said.
class Station {
 public:
  explicit Station(mavlink::Version version = mavlink::Version::v2)
      : sender_{version, station_system, station_component} {}

  Voice& voice() { return voice_; }
  void set_version(mavlink::Version version) { sender_.set_version(version); }

  /// The messages of this type that have been sent since the last call; all others are forgotten, too.
  template <mavlink::Message M>
  std::vector<M> take() {
    std::vector<M> result;
    out_.drain([&](const OutgoingFrame& frame) {
      const auto view = mavlink::parse_frame(frame.bytes());
      PONTE_ASSERT(view.has_value());
      if (mavlink::carries<M>(*view)) result.push_back(mavlink::decode<M>(*view));
    });
    return result;
  }
  [[nodiscard]] bool is_silent() const { return out_.empty(); }

 private:
  mavlink::FrameSender sender_;
  Outbox<OutgoingFrame> out_{64};
  Voice voice_{sender_, LinkId{1}, out_};
};

/// What came out of an outbox since the last call.
template <class Fact>
std::vector<Fact> take(Outbox<Fact>& facts) {
  std::vector<Fact> result;
  facts.drain([&](const Fact& fact) { result.push_back(fact); });
  return result;
}

}  // namespace ponte::autopilot::testing
