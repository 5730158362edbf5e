#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/id.hpp"
#include "ponte/core/result.hpp"
#include "ponte/core/time.hpp"
#include "ponte/transport/endpoint.hpp"
#include "ponte/transport/loop.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace ponte::transport {

/// One remote end of a link: a UDP sender, or one connection. Within a link no number is used twice: who comes back is
/// someone else.
using PeerId = Id<struct PeerIdTag, std::uint32_t>;

enum class LinkState {
  connecting,  ///< told once, at the start, by links that have to reach something
  up,
  down,  ///< comes up again by itself, unless the link was opened without `reconnect`
};
[[nodiscard]] std::string_view name_of(LinkState state);

enum class PeerChange { joined, left };

/// Is told what happens on a link. All calls come on the loop's thread and never within `open_link` or a call of the
/// link. A handler may send on the link and destroy it; destroying it ends the calls.
class LinkHandler {
 public:
  virtual ~LinkHandler() = default;

  /// The next bytes of a stream, in pieces of any size. `now` was taken right after the last of them was received; the
  /// bytes are valid during the call.
  virtual void on_bytes(Timestamp now, Bytes bytes, PeerId peer) = 0;
  /// One whole datagram, which may be empty; otherwise like `on_bytes`.
  virtual void on_datagram(Timestamp now, Bytes bytes, PeerId peer) = 0;
  /// Once per change, never per attempt. The reason is one line for people, e.g. "/dev/ttyACM0 is missing".
  virtual void on_state(Timestamp now, LinkState state, std::string_view reason) = 0;
  /// A peer is told of before its first bytes, and after its last. `name` is its address.
  virtual void on_peer(Timestamp /*now*/, PeerId /*peer*/, PeerChange /*change*/, std::string_view /*name*/) {}
};

/// Why bytes did not get through.
enum class DropReason {
  queue_full,        ///< out: the peer, or the network, takes less than is sent; the oldest message gave way
  not_connected,     ///< out: nobody is there
  disconnected,      ///< out: was waiting or on its way when the connection ended
  oversize,          ///< out: larger than a datagram or the queue can be
  unreachable,       ///< out: the system refused it: no route, no listener on the port
  too_many_peers,    ///< in: from a sender, or a connection, beyond the limit
  receive_overflow,  ///< in: the system's receive buffer was full
};
inline constexpr std::size_t drop_reason_count = 7;
[[nodiscard]] std::string_view name_of(DropReason reason);

/// What happened on a link since it was opened.
struct LinkCounters {
  std::uint64_t bytes_in{};
  std::uint64_t bytes_out{};
  std::uint64_t datagrams_in{};  ///< 0 on streams
  std::uint64_t messages_out{};  ///< what was sent, whole, counted once per peer
  std::uint64_t reconnects{};    ///< how often it came up after it had been down
  std::uint64_t peers_joined{};
  std::uint64_t peers_left{};
  std::array<std::uint64_t, drop_reason_count> dropped{};  ///< messages, datagrams or connections

  [[nodiscard]] std::uint64_t& dropped_by(DropReason reason) { return dropped[static_cast<std::size_t>(reason)]; }
  [[nodiscard]] std::uint64_t dropped_by(DropReason reason) const { return dropped[static_cast<std::size_t>(reason)]; }
};

/// What waits to be sent to one peer of a stream.
struct QueueLimits {
  std::size_t bytes = 65'536;  ///< a larger message cannot be sent
  std::size_t messages = 256;
};

/// Limits and times of links; what there is by default suits telemetry.
struct LinkOptions {
  QueueLimits queue{};
  std::size_t peers = 64;  ///< UDP senders, or TCP connections, at a time
  /// A UDP sender that is silent for longer is forgotten: it is not sent to any more and leaves room for another.
  Duration peer_silence = std::chrono::seconds{60};
  bool reconnect = true;
  Duration retry_first = std::chrono::milliseconds{100};  ///< then twice as long each time
  Duration retry_longest = std::chrono::seconds{2};
  Duration connect_limit = std::chrono::seconds{5};  ///< for a TCP peer that does not answer at all
};

/// An open endpoint. Destroying it closes everything at once. To be used on the loop's thread only.
///
/// Nothing here waits. A datagram goes out or is dropped and counted. On a stream, each peer has a queue of its own, so
/// that a slow or dead one keeps nobody else waiting; when it is full the oldest message that has not begun to leave is
/// dropped and counted. Only whole messages are dropped.
class Link {
 public:
  virtual ~Link() = default;

  /// Sends one message to everyone who is known: the connections there are, the UDP senders who talked lately, the
  /// group. The bytes may go away after the call.
  virtual void send(Bytes message) = 0;
  /// Sends to one peer; on a multicast link to the group all the same.
  virtual void send_to(PeerId peer, Bytes message) = 0;

  [[nodiscard]] virtual const LinkCounters& counters() const = 0;
  [[nodiscard]] virtual LinkState state() const = 0;
  /// The endpoint, as configured.
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// The address of a peer, e.g. "127.0.0.1:14550"; empty when it is not there.
  [[nodiscard]] virtual std::string peer_name(PeerId peer) const = 0;
  /// The local port, which tells what the kernel chose for port 0; 0 where there is none.
  [[nodiscard]] virtual std::uint16_t local_port() const = 0;
};

/// What prevents a start.
struct OpenError {
  std::string endpoint;
  std::string reason;
};
/// "ENDPOINT: REASON"
[[nodiscard]] std::string to_text(const OpenError& error);

/// Opens an endpoint. Errors are what waiting does not cure: a local address that is in use or not ours, a group that
/// cannot be joined, a file (see `Replay`), and with `reconnect` off a serial port that cannot be opened. What is
/// merely not there yet makes a link that is down and goes on trying. The loop and the handler outlive the link.
[[nodiscard]] Result<std::unique_ptr<Link>, OpenError> open_link(Loop& loop, const Endpoint& endpoint,
                                                                 LinkHandler& handler, const LinkOptions& options = {});

}  // namespace ponte::transport
