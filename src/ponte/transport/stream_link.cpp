#include "ponte/transport/stream_link.hpp"

#include "ponte/transport/device_link.hpp"

#include <algorithm>
#include <utility>

namespace ponte::transport {

void StreamLink::start() { spawn(loop_, run(shared_from_this())); }

asio::awaitable<void> StreamLink::run(std::shared_ptr<StreamLink> self) {
  self->tell_state(LinkState::connecting, "trying");
  auto delay = self->options_.retry_first;
  while (!self->closed()) {
    auto opened = co_await self->open();
    if (self->closed()) break;
    if (opened) {
      const auto began = self->loop_.now();
      co_await self->serve(*std::move(opened));
      // A peer that accepts us only to hang up is not called at full speed.
      if (self->loop_.now() - began > self->options_.retry_longest) delay = self->options_.retry_first;
    } else {
      self->tell_state(LinkState::down, opened.error());
    }
    if (self->closed() || !self->options_.reconnect) break;

    error_code error;
    auto token = asio::redirect_error(asio::use_awaitable, error);
    self->pause_.expires_after(delay);
    co_await self->pause_.async_wait(token);
    delay = std::min(delay * 2, self->options_.retry_longest);
  }
}

asio::awaitable<void> StreamLink::serve(OpenedStream stream) {
  const auto connection =
      std::make_shared<StreamConnection>(loop_, std::move(stream.descriptor), stream.kind, options_.queue, counters_);
  connection_ = connection;
  peer_ = next_peer_id();
  peer_name_ = stream.peer_name;
  tell_state(LinkState::up, peer_name_);
  tell_peer(peer_, PeerChange::joined, peer_name_);

  StreamConnection::OnBytes on_bytes = [this](Timestamp now, Bytes bytes) { handler_.on_bytes(now, bytes, peer_); };
  const auto reason = co_await connection->read_until_closed(std::move(on_bytes));
  connection_ = nullptr;
  tell_peer(peer_, PeerChange::left, peer_name_);
  tell_state(LinkState::down, describe_end(reason));
}

void StreamLink::send(Bytes message) {
  if (connection_) {
    connection_->send(message);
  } else {
    drop(DropReason::not_connected);
  }
}

void StreamLink::send_to(PeerId peer, Bytes message) {
  if (connection_ && peer == peer_) {
    connection_->send(message);
  } else {
    drop(DropReason::not_connected);
  }
}

std::string StreamLink::peer_name(PeerId peer) const {
  return connection_ && peer == peer_ ? peer_name_ : std::string{};
}

void StreamLink::close_all() {
  pause_.cancel();
  if (connection_) connection_->close();
}

namespace {

class DeviceLink final : public StreamLink {
 public:
  DeviceLink(Loop& loop, Device device, LinkHandler& handler, const LinkOptions& options)
      : StreamLink{loop, device.endpoint, handler, options}, device_{std::move(device)} {}

 private:
  asio::awaitable<Opened> open() override {
    co_return device_.open().map([this](FileDescriptor&& descriptor) {
      return OpenedStream{std::move(descriptor), StreamKind::terminal, device_.name};
    });
  }

  [[nodiscard]] std::string describe_end(const std::string&) const override { return device_.description_of_loss; }

  void close_all() override {
    StreamLink::close_all();
    device_.open = nullptr;  // with everything it holds
  }

  Device device_;
};

}  // namespace

std::unique_ptr<Link> make_device_link(Loop& loop, Device device, LinkHandler& handler, const LinkOptions& options) {
  return std::make_unique<LinkHandle>(std::make_shared<DeviceLink>(loop, std::move(device), handler, options));
}

}  // namespace ponte::transport
