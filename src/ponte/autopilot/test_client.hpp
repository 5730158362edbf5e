#pragma once

#include "ponte/autopilot/peer.hpp"
#include "ponte/autopilot/test_frames.hpp"
#include "ponte/autopilot/voice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

/// For the tests of the services in this folder.
namespace ponte::autopilot::testing {

/// A client, and the vehicle's part, which is played by hand.
template <class Client, class Fact>
class ClientTest : public ::testing::Test {
 protected:
  void use(Stack stack) { client_.emplace(Peer{vehicle_system, autopilot_component, stack}); }

  /// The vehicle says something.
  void hear(const TestFrame& frame) { client_->on_message(now_, frame.view(), voice_, facts_); }

  /// Lets the time go by, with all that is due.
  void wait(Duration duration) {
    for (const auto end = now_ + duration;;) {
      const auto next = client_->next_deadline();
      if (!next || *next > end) {
        now_ = end;
        return;
      }
      now_ = std::max(now_, *next);
      client_->on_tick(now_, voice_, facts_);
    }
  }

  /// The facts since the last call, without progress.
  std::vector<Fact> facts() {
    std::vector<Fact> result;
    facts_.drain([&](const Fact& fact) {
      if (fact.kind != Fact::Kind::progress) result.push_back(fact);
    });
    return result;
  }

  std::optional<Client> client_;
  mavlink::FrameSender sender_{mavlink::Version::v2, station_system, station_component};
  Outbox<OutgoingFrame> out_{64};
  Voice voice_{sender_, LinkId{1}, out_};
  Outbox<Fact> facts_{64};
  Timestamp now_{};
};

}  // namespace ponte::autopilot::testing
