#pragma once

#include "ponte/transport/link.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace ponte::transport {

/// What all links have in common. Operations in progress share a link with its owner; after `close`, which the owner's
/// handle calls, they find it closed and end without calling the handler.
class SharedLink : public Link {
 public:
  SharedLink(Loop& loop, std::string name, LinkHandler& handler, const LinkOptions& options)
      : loop_{loop}, handler_{handler}, options_{options}, name_{std::move(name)} {}

  /// Begins the operations that go on until `close`; none of them calls the handler before the loop runs.
  virtual void start() = 0;

  /// Ends all operations, once.
  void close() {
    closed_ = true;
    close_all();
  }

  [[nodiscard]] const LinkCounters& counters() const final { return counters_; }
  [[nodiscard]] LinkState state() const final { return state_.value_or(LinkState::connecting); }
  [[nodiscard]] std::string_view name() const final { return name_; }

 protected:
  virtual void close_all() = 0;

  [[nodiscard]] bool closed() const { return closed_; }
  [[nodiscard]] PeerId next_peer_id() { return PeerId{++last_peer_id_}; }
  void drop(DropReason reason, std::uint64_t count = 1) { counters_.dropped_by(reason) += count; }

  void tell_state(LinkState state, std::string_view reason) {
    if (closed_ || state_ == state) return;
    if (state == LinkState::up && std::exchange(was_up_, true)) ++counters_.reconnects;
    state_ = state;
    handler_.on_state(loop_.now(), state, reason);
  }

  void tell_peer(PeerId peer, PeerChange change, std::string_view name) {
    if (closed_) return;
    ++(change == PeerChange::joined ? counters_.peers_joined : counters_.peers_left);
    handler_.on_peer(loop_.now(), peer, change, name);
  }

  Loop& loop_;
  LinkHandler& handler_;
  const LinkOptions options_;
  LinkCounters counters_{};

 private:
  std::string name_;
  std::optional<LinkState> state_{};
  std::uint32_t last_peer_id_{};
  bool was_up_{};
  bool closed_{};
};

/// The owner's handle of a link that is shared; starts it, and closes it at the end.
class LinkHandle final : public Link {
 public:
  explicit LinkHandle(std::shared_ptr<SharedLink> link) : link_{std::move(link)} { link_->start(); }
  ~LinkHandle() override { link_->close(); }
  LinkHandle(const LinkHandle&) = delete;
  LinkHandle& operator=(const LinkHandle&) = delete;

  void send(Bytes message) override { link_->send(message); }
  void send_to(PeerId peer, Bytes message) override { link_->send_to(peer, message); }
  [[nodiscard]] const LinkCounters& counters() const override { return link_->counters(); }
  [[nodiscard]] LinkState state() const override { return link_->state(); }
  [[nodiscard]] std::string_view name() const override { return link_->name(); }
  [[nodiscard]] std::string peer_name(PeerId peer) const override { return link_->peer_name(peer); }
  [[nodiscard]] std::uint16_t local_port() const override { return link_->local_port(); }

 private:
  std::shared_ptr<SharedLink> link_;
};

}  // namespace ponte::transport
