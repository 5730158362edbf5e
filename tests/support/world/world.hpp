#pragma once

#include "support/world/channel.hpp"
#include "support/world/timeline.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ponte::world {

/// One end of a link, as its participant sees it: the first link that is connected to it is 0.
using Port = std::size_t;

/// Where a participant puts what it sends.
class Sender {
 public:
  virtual ~Sender() = default;
  virtual void send(Port port, Bytes piece) = 0;
  virtual void send_to_all(Bytes piece) = 0;
  /// Something that happened, for the timeline.
  virtual void tell(std::string_view text) = 0;
};

/// Something that lives in a world: an engine with its parsers, and no clock.
class Participant {
 public:
  virtual ~Participant() = default;
  virtual void on_piece(Timestamp now, Port port, Bytes piece, Sender& out) = 0;
  virtual void on_tick(Timestamp now, Sender& out) = 0;
  /// When `on_tick` is to be called next; nothing: only once something arrives.
  [[nodiscard]] virtual std::optional<Timestamp> next_deadline() const = 0;
};

/// A property did not hold.
struct BrokenProperty : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Participants, and links between them, in a time of their own that goes from event to event. Everything that happens
/// follows from the seed.
class World {
 public:
  explicit World(std::uint64_t seed, Timeline timeline = Timeline::chosen()) : seed_{seed}, timeline_{timeline} {}

  /// The name is for the timeline.
  template <class P, class... Args>
  P& add(std::string name, Args&&... args) {
    auto participant = std::make_unique<P>(std::forward<Args>(args)...);
    auto& reference = *participant;
    enter(std::move(name), std::move(participant));
    return reference;
  }
  /// Both directions alike. The number of the link.
  std::size_t connect(const Participant& one, const Participant& other, const ChannelConfig& config);

  /// Nothing that is sent on the link from now on, until then, arrives.
  void cut(std::size_t link, Timestamp until);

  /// Does something when that time has come.
  void at(Timestamp time, std::function<void()> work);
  /// Is asked after every event: what is wrong, or nothing.
  void require(std::string property, std::function<std::optional<std::string>()> wrong);

  // They throw `BrokenProperty`.

  void run_until(Timestamp end);
  void run_for(Duration duration) { run_until(now_ + duration); }
  /// Until the condition holds, which is asked after every event; false if it does not before `limit` is over.
  [[nodiscard]] bool run_until(const std::function<bool()>& condition, Duration limit);

  [[nodiscard]] Timestamp now() const { return now_; }
  /// Of both directions together.
  [[nodiscard]] ChannelCounters counters(std::size_t link) const;
  /// Of every piece that was sent, with its time and its sender: two worlds with the same digest were the same.
  [[nodiscard]] std::uint64_t digest() const { return digest_; }

 private:
  struct End {
    std::size_t participant{};
    Port port{};
  };
  struct Direction {
    Channel channel;
    End from;
    End to;
  };
  struct Inhabitant {
    std::string name;
    std::unique_ptr<Participant> participant;
    std::vector<std::size_t> directions;  // by port: the one that leads away
  };
  class Mouth;

  void enter(std::string name, std::unique_ptr<Participant> participant);
  [[nodiscard]] std::size_t index_of(const Participant& participant) const;
  void add_direction(End from, End to, const ChannelConfig& config);
  [[nodiscard]] std::optional<Timestamp> next_event() const;
  void step(Timestamp time);
  void check() const;
  void mix(Bytes bytes);

  std::uint64_t seed_;
  Timeline timeline_;
  Timestamp now_{};
  std::uint64_t digest_{0xCBF29CE484222325};
  std::vector<Inhabitant> inhabitants_;
  std::vector<Direction> directions_;  // two for each link
  std::multimap<Timestamp, std::function<void()>> agenda_;
  std::vector<std::pair<std::string, std::function<std::optional<std::string>()>>> properties_;
};

}  // namespace ponte::world
