#pragma once

#include "ponte/core/assert.hpp"
#include "ponte/core/time.hpp"
#include "ponte/transport/link.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace ponte::transport {

/// Who talked on a datagram socket lately, up to a limit.
template <class Address>
class PeerTable {
 public:
  struct Peer {
    PeerId id{};
    Address address{};
    Timestamp last_heard{};
  };

  PeerTable(std::size_t limit, Duration silence_limit) : limit_{limit}, silence_limit_{silence_limit} {
    peers_.reserve(limit);
  }

  /// The peer with that address, who talked now; nothing if it is unknown.
  [[nodiscard]] const Peer* hear(Timestamp now, const Address& address) {
    const auto peer = std::ranges::find(peers_, address, &Peer::address);
    if (peer == peers_.end()) return nullptr;
    peer->last_heard = now;
    return &*peer;
  }

  [[nodiscard]] bool full() const { return peers_.size() >= limit_; }

  /// Adds a peer that is unknown and talked now. There is room for it.
  const Peer& add(Timestamp now, PeerId id, const Address& address) {
    PONTE_ASSERT(!full());
    return peers_.emplace_back(Peer{id, address, now});
  }

  /// Takes out the peers that have been silent for the limit.
  [[nodiscard]] std::vector<Peer> take_silent(Timestamp now) {
    std::vector<Peer> silent;
    std::erase_if(peers_, [&](const Peer& peer) {
      const auto is_silent = now - peer.last_heard >= silence_limit_;
      if (is_silent) silent.push_back(peer);
      return is_silent;
    });
    return silent;
  }

  /// When `take_silent` next has something to give; nothing while nobody is known.
  [[nodiscard]] std::optional<Timestamp> next_deadline() const {
    const auto silent = std::ranges::min_element(peers_, {}, &Peer::last_heard);
    if (silent == peers_.end()) return {};
    return silent->last_heard + silence_limit_;
  }

  [[nodiscard]] const Peer* find(PeerId id) const {
    const auto peer = std::ranges::find(peers_, id, &Peer::id);
    return peer == peers_.end() ? nullptr : &*peer;
  }

  [[nodiscard]] const std::vector<Peer>& all() const { return peers_; }

 private:
  std::size_t limit_;
  Duration silence_limit_;
  std::vector<Peer> peers_;
};

}  // namespace ponte::transport
