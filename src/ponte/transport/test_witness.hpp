#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/transport/link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ponte::transport::testing {

/// Long enough for a machine that has much else to do; only a test that fails waits for it.
inline constexpr auto patience = std::chrono::seconds{30};

[[nodiscard]] inline bool wait_for(Loop& loop, const std::function<bool()>& reached) {
  return loop.run_until(reached, patience);
}

[[nodiscard]] inline std::string text_of(Bytes bytes) {
  std::string text;
  for (const auto byte : bytes) text.push_back(static_cast<char>(std::to_integer<unsigned char>(byte)));
  return text;
}

struct Datagram {
  PeerId peer;
  std::string text;

  friend bool operator==(const Datagram&, const Datagram&) = default;
};

/// Remembers what happened on a link, and does what a test wants done about it.
class Witness : public LinkHandler {
 public:
  void on_bytes(Timestamp now, Bytes bytes, PeerId peer) override {
    times.push_back(now);
    streams[peer] += text_of(bytes);
    if (and_then) and_then();
  }
  void on_datagram(Timestamp now, Bytes bytes, PeerId peer) override {
    times.push_back(now);
    datagrams.push_back({peer, text_of(bytes)});
    if (and_then) and_then();
  }
  void on_state(Timestamp, LinkState state, std::string_view reason) override {
    states.push_back(state);
    reasons.emplace_back(reason);
  }
  void on_peer(Timestamp, PeerId peer, PeerChange change, std::string_view name) override {
    if (change == PeerChange::joined) {
      joined.push_back(peer);
    } else {
      left.push_back(peer);
    }
    names[peer] = name;
  }

  [[nodiscard]] bool is_up() const { return !states.empty() && states.back() == LinkState::up; }
  [[nodiscard]] bool is_down() const { return !states.empty() && states.back() == LinkState::down; }
  [[nodiscard]] std::vector<std::string> texts() const {
    std::vector<std::string> result;
    for (const auto& each : datagrams) result.push_back(each.text);
    return result;
  }

  std::vector<LinkState> states;
  std::vector<std::string> reasons;
  std::vector<PeerId> joined;
  std::vector<PeerId> left;
  std::map<PeerId, std::string> names;
  std::vector<Datagram> datagrams;
  std::map<PeerId, std::string> streams;
  std::vector<Timestamp> times;
  std::function<void()> and_then;
};

/// Opens what a test takes for granted.
[[nodiscard]] inline std::unique_ptr<Link> must_open(Loop& loop, std::string_view endpoint, LinkHandler& handler,
                                                     const LinkOptions& options = {}) {
  auto link = open_link(loop, parse_endpoint(endpoint).value(), handler, options);
  if (!link) throw std::runtime_error{to_text(link.error())};
  return *std::move(link);
}

/// "udpout://127.0.0.1:PORT" for the port that a link listens on.
[[nodiscard]] inline std::string at_port_of(std::string_view scheme_and_host, const Link& link) {
  return std::string{scheme_and_host} + ':' + std::to_string(link.local_port());
}

}  // namespace ponte::transport::testing
