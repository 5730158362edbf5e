// Floods the router over loopback UDP, from one endpoint to another, beside a relay that passes the same datagrams on
// untouched: how many messages come through, and what one costs the processor.

#include "loopback.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/codec.hpp"
#include "recording.hpp"
#include "route/live_router.hpp"

#include <atomic>
#include <chrono>
#include <ctime>
#include <limits>
#include <thread>
#include <vector>

namespace {

using namespace ponte;
using bench::Socket;
using Clock = std::chrono::steady_clock;

constexpr std::array<double, 5> rates{160'000, 200'000, 250'000, 300'000, 400'000};  // messages per second
constexpr int tries = 3;  // at one rate, until all messages come through
constexpr std::size_t batch_size = 32;
constexpr int buffer_bytes = 4 * 1024 * 1024;

/// The message with this number.
struct Message {
  explicit Message(std::uint32_t number) {
    const mavlink::FrameHeader header{.system = mavlink::SystemId{1},
                                      .component = mavlink::ComponentId{1},
                                      .sequence = static_cast<std::uint8_t>(number)};
    // No byte of the payload's end is 0, so all messages are equally long.
    const mavlink::autopilots::Attitude attitude{.time_boot_ms = number, .yawspeed = 1};
    size = *mavlink::encode(attitude, header, bytes);
  }
  std::array<std::byte, mavlink::max_frame_size> bytes{};
  std::size_t size{};
};

/// Several datagrams for one system call.
class Batch {
 public:
  Batch() {
    for (std::size_t i = 0; i < batch_size; ++i) {
      parts_[i] = {buffers_[i].data(), buffers_[i].size()};
      headers_[i].msg_hdr.msg_iov = &parts_[i];
      headers_[i].msg_hdr.msg_iovlen = 1;
    }
  }

  void put(std::size_t place, const Message& message) {
    std::copy_n(message.bytes.begin(), message.size, buffers_[place].begin());
    parts_[place].iov_len = message.size;
  }
  void send(int socket, std::size_t count) {
    for (std::size_t sent = 0; sent < count;) {
      const auto done = sendmmsg(socket, &headers_[sent], static_cast<unsigned>(count - sent), 0);
      if (done > 0) sent += static_cast<std::size_t>(done);
    }
  }
  /// The datagrams that are there; nothing if none comes for a while.
  template <class Visitor>
  void receive(int socket, Visitor&& visit) {
    const auto count = recvmmsg(socket, headers_.data(), batch_size, MSG_WAITFORONE, nullptr);
    for (int i = 0; i < count; ++i) {
      const auto place = static_cast<std::size_t>(i);
      visit(Bytes{buffers_[place]}.first(headers_[place].msg_len));
    }
  }

 private:
  std::array<std::array<std::byte, mavlink::max_frame_size>, batch_size> buffers_{};
  std::array<iovec, batch_size> parts_{};
  std::array<mmsghdr, batch_size> headers_{};
};

double processor_seconds(std::thread& thread) {
  clockid_t clock{};
  timespec time{};
  if (pthread_getcpuclockid(thread.native_handle(), &clock) != 0 || clock_gettime(clock, &time) != 0)
    throw std::runtime_error{"the processor time of a thread is not known"};
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

struct Flood {
  double rate{};  ///< messages per second, as sent
  std::size_t lost{};
  double processor_ns{};  ///< of the one in between, for a message
};

/// For a second from `sender` to `receiver`, by way of `port`, where `between` listens.
Flood flood(const Socket& sender, const Socket& receiver, std::uint16_t port, std::thread& between, double rate) {
  const auto count = static_cast<std::uint32_t>(rate);
  std::vector<char> arrived(count);
  std::atomic<bool> all_sent{};
  std::thread listener{[&] {
    Batch batch;
    for (bool got_some = true; got_some || !all_sent;) {
      got_some = false;
      batch.receive(receiver.number(), [&](Bytes frame) {
        got_some = true;
        const auto view = mavlink::parse_frame(frame);
        if (!view || view->message != mavlink::autopilots::Attitude::info.id) return;
        const auto number = mavlink::decode<mavlink::autopilots::Attitude>(*view).time_boot_ms;
        if (number < count) arrived[number] = 1;
      });
    }
  }};

  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  place.sin_port = htons(port);
  if (connect(sender.number(), reinterpret_cast<const sockaddr*>(&place), sizeof place) != 0)
    throw std::runtime_error{"no UDP on loopback"};
  const auto busy_before = processor_seconds(between);
  const auto begin = Clock::now();
  Batch batch;
  for (std::uint32_t sent = 0; sent < count;) {
    const auto size = std::min<std::size_t>(batch_size, count - sent);
    for (std::size_t i = 0; i < size; ++i) batch.put(i, Message{sent++});
    batch.send(sender.number(), size);
    std::this_thread::sleep_until(begin + std::chrono::duration<double>{sent / rate});
  }
  const std::chrono::duration<double> took = Clock::now() - begin;
  all_sent = true;
  listener.join();
  const auto busy = processor_seconds(between) - busy_before;
  return {.rate = count / took.count(),
          .lost = static_cast<std::size_t>(std::ranges::count(arrived, 0)),
          .processor_ns = busy / count * 1e9};
}

/// Floods at higher and higher rates, as long as all messages come through, and prints what was reached.
void measure(std::string_view name, const Socket& sender, const Socket& receiver, std::uint16_t port,
             std::thread& between) {
  double most{};
  for (const auto rate : rates) {
    Flood best{.lost = std::numeric_limits<std::size_t>::max()};
    for (int i = 0; i < tries && best.lost > 0; ++i)
      if (const auto next = flood(sender, receiver, port, between, rate); next.lost < best.lost) best = next;
    if (rate == rates.front()) {
      bench::print(fmt::format("{} lost", name), static_cast<double>(best.lost), "messages");
      bench::print(fmt::format("{} processor", name), best.processor_ns, "ns/msg");
    }
    if (best.lost > 0) break;
    most = best.rate;
  }
  bench::print(fmt::format("{} without loss", name), most, "msg/s");
}

/// A socket that keeps what comes in a burst, and does not wait for ever.
struct FloodSocket : Socket {
  FloodSocket() {
    const timeval patience{.tv_sec = 0, .tv_usec = 200'000};
    setsockopt(number(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    setsockopt(number(), SOL_SOCKET, SO_RCVBUF, &buffer_bytes, sizeof buffer_bytes);
  }
};

/// Runs `loop` on a thread of its own while `work` goes on.
template <class Work>
void beside(transport::Loop& loop, Work&& work) {
  std::thread thread{[&] { loop.run(); }};
  work(thread);
  loop.stop();
  thread.join();
}

}  // namespace

int main() {
  const FloodSocket sender;
  const FloodSocket receiver;
  const auto [relay_port, near_port] = bench::free_ports<2>();
  {
    transport::Loop loop;
    const bench::Relay relay{loop, relay_port, receiver.port()};
    beside(loop, [&](std::thread& thread) { measure("relay", sender, receiver, relay_port, thread); });
  }
  transport::Loop loop;
  app::LiveRouter router{loop, app::make_log({.quiet = true})};
  router.add(transport::UdpInEndpoint{{"127.0.0.1", near_port}}, {});
  router.add(transport::UdpOutEndpoint{{"127.0.0.1", receiver.port()}}, {});
  beside(loop, [&](std::thread& thread) { measure("router", sender, receiver, near_port, thread); });
  return 0;
}
