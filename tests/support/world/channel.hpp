#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/random.hpp"
#include "ponte/core/time.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace ponte::world {

/// What one direction of a simulated network does to what is sent. By default nothing: all arrives at once.
struct ChannelConfig {
  Duration delay{};
  Duration jitter{};  ///< added to the delay: anything from 0 to this
  double loss{};      ///< chances, for each piece, from here on
  double burst_begins{};
  double burst_ends{0.2};  ///< until then every piece is lost
  double duplication{};
  double reordering{};                                ///< to be overtaken by what is sent later
  Duration held_back{std::chrono::milliseconds{50}};  ///< for so long, if it is
  double bit_flips{};                                 ///< for each byte: to arrive with one bit changed
  std::uint32_t bytes_per_second{};                   ///< 0: no limit. 57600 baud are 5760
  std::size_t fifo_bytes{4096};                       ///< what waits to be sent; more is lost
};

/// What became of the pieces.
struct ChannelCounters {
  std::uint64_t sent{};
  std::uint64_t delivered{};  ///< with duplicates
  std::uint64_t lost{};       ///< by chance and in bursts
  std::uint64_t cut_off{};
  std::uint64_t overflowed{};
  std::uint64_t duplicated{};
  std::uint64_t reordered{};
  std::uint64_t changed{};

  friend bool operator==(const ChannelCounters&, const ChannelCounters&) = default;
};

/// One direction of a link. What happens to a piece, a datagram or a part of a stream, follows from the seed, from the
/// time, and from what was sent before.
class Channel {
 public:
  Channel(const ChannelConfig& config, std::uint64_t seed) : config_{config}, random_{seed} {}

  /// Whatever is sent before that time is lost.
  void cut_until(Timestamp time) { cut_until_ = time; }

  enum class Fate : std::uint8_t { on_its_way, lost, cut_off, overflowed };
  Fate send(Timestamp now, Bytes piece);

  /// When the next piece arrives.
  [[nodiscard]] std::optional<Timestamp> next_arrival() const;
  /// Takes the piece that arrives next.
  [[nodiscard]] std::vector<std::byte> take_arrival();

  [[nodiscard]] const ChannelCounters& counters() const { return counters_; }

 private:
  using Place = std::pair<Timestamp, std::uint64_t>;  // the number tells apart what arrives at the same time

  [[nodiscard]] bool chance(double probability) { return probability > 0 && random_.chance(probability); }
  [[nodiscard]] bool is_lost();
  [[nodiscard]] std::optional<Timestamp> leave(Timestamp now, std::size_t size);
  void put(Timestamp arrival, Bytes piece);

  ChannelConfig config_;
  Random random_;
  ChannelCounters counters_;
  Timestamp cut_until_{};
  Timestamp idle_from_{};  // nothing more waits to be sent
  Timestamp last_arrival_{};
  bool in_burst_{};
  std::uint64_t number_{};
  std::map<Place, std::vector<std::byte>> underway_;
};

[[nodiscard]] std::string_view name_of(Channel::Fate fate);

}  // namespace ponte::world
