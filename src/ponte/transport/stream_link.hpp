#pragma once

#include "ponte/transport/asio.hpp"
#include "ponte/transport/shared_link.hpp"
#include "ponte/transport/stream_connection.hpp"

#include <memory>
#include <string>
#include <utility>

namespace ponte::transport {

/// A stream that was reached.
struct OpenedStream {
  FileDescriptor descriptor;
  StreamKind kind{};
  std::string peer_name;
};

/// A link with one peer at a time that we have to reach, again and again. How is left to what derives from it.
class StreamLink : public SharedLink, public std::enable_shared_from_this<StreamLink> {
 public:
  StreamLink(Loop& loop, std::string name, LinkHandler& handler, const LinkOptions& options)
      : SharedLink{loop, std::move(name), handler, options}, pause_{loop.context()} {}

  void start() override;
  void send(Bytes message) override;
  void send_to(PeerId peer, Bytes message) override;
  [[nodiscard]] std::string peer_name(PeerId peer) const override;
  [[nodiscard]] std::uint16_t local_port() const override { return 0; }

 protected:
  using Opened = Result<OpenedStream, std::string>;
  /// One attempt. The error is one line that names the place.
  virtual asio::awaitable<Opened> open() = 0;
  /// One line for a connection that has ended.
  [[nodiscard]] virtual std::string describe_end(const std::string& reason) const = 0;
  void close_all() override;

 private:
  static asio::awaitable<void> run(std::shared_ptr<StreamLink> self);
  asio::awaitable<void> serve(OpenedStream stream);
  std::shared_ptr<StreamConnection> connection_;  ///< nothing while the link is not up
  PeerId peer_{};
  std::string peer_name_;
  asio::steady_timer pause_;  ///< between attempts
};

}  // namespace ponte::transport
