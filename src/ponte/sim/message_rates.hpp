#pragma once

#include "ponte/core/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace ponte::sim {

/// MAV_DATA_STREAM: the groups that REQUEST_DATA_STREAM turns on together.
enum class Stream : std::uint8_t {
  all = 0,
  raw_sensors = 1,
  extended_status = 2,
  rc_channels = 3,
  position = 6,
  extra1 = 10,
  extra2 = 11,
  extra3 = 12,
  none = 255,  ///< no group: each message is asked for by itself
};

/// How a message is asked for, and how often it comes by itself (0: never).
struct Rate {
  Stream stream{Stream::none};
  Duration unasked{};
};

/// Which messages are due, of a list whose streams are known. Whatever was asked last for a message holds.
class MessageRates {
 public:
  static constexpr std::size_t capacity = 40;
  /// Nothing is sent more often, since nothing changes more often.
  static constexpr Duration shortest_interval = std::chrono::milliseconds{20};

  /// Of each row of the list its member `rate`; at most `capacity` of them.
  template <class Row>
  explicit MessageRates(std::span<const Row> rows) {
    for (const auto& each : rows) add(each.rate);
  }

  /// REQUEST_DATA_STREAM: all messages of the stream, this often from now on; 0: no more. Unknown streams are empty.
  void request_stream(Stream stream, std::uint32_t per_second, Duration now);

  /// SET_MESSAGE_INTERVAL: one message; nothing as interval: no more.
  void set_interval(std::size_t message, std::optional<Duration> interval, Duration now);
  /// Back to the interval of its stream.
  void reset_interval(std::size_t message, Duration now);

  /// The interval at which it is sent; 0: not at all.
  [[nodiscard]] Duration interval(std::size_t message) const { return entries_[message].interval; }
  /// Whether the message is to be sent now; asked once per step for each message.
  [[nodiscard]] bool take_due(std::size_t message, Duration now);

 private:
  struct Entry {
    Stream stream{Stream::none};
    Duration stream_interval{};  // 0: off
    Duration interval{};         // 0: off
    Duration due{};
  };

  void add(const Rate& rate);
  static void start(Entry& entry, Duration interval, Duration now);

  std::size_t count_{};
  std::array<Entry, capacity> entries_{};
};

}  // namespace ponte::sim
