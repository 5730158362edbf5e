#pragma once

#include "ponte/sim/flight_context.hpp"
#include "ponte/sim/mission_item.hpp"
#include "ponte/sim/return_flight.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace ponte::sim {

/// Flies the mission on board: one item that is flown after the other, and what is to be done on the way between them.
class MissionFlight {
 public:
  MissionFlight() { pending_.reserve(most_pending); }

  /// The items as they are stored, which stay valid until the next call. It begins at the first again, unless one is
  /// being flown that is still there.
  void set_items(std::span<const MissionItem> items, Personality personality);

  /// Flies on where it was left, or from the start if it was finished. With nothing to fly it holds.
  void begin(const FlightContext& flight);
  void step(const FlightContext& flight);
  /// Goes on with this item; at once if the mission is being flown (`is_active`). False: there is none.
  [[nodiscard]] bool set_current(std::uint16_t item, bool is_active, const FlightContext& flight);
  /// Stays where it is on its way to an item. False: it is not on its way.
  [[nodiscard]] bool pause(const FlightContext& flight);
  /// Flies on to the item. False: it is not on its way.
  [[nodiscard]] bool go_on(const FlightContext& flight);
  /// The next flight begins with the first item.
  void rewind();
  /// Of legs from now on (m/s), until the mission is rewound.
  void set_speed(MetresPerSecond speed, const FlightContext& flight);

  [[nodiscard]] bool has_items() const { return first_ < items_.size(); }
  /// The item that is flown, or that would be.
  [[nodiscard]] std::uint16_t current() const { return current_; }
  [[nodiscard]] bool is_finished() const { return finished_; }
  /// It begins with a take-off, or goes on with one.
  [[nodiscard]] bool is_taking_off() const { return leg_ == Leg::take_off; }
  [[nodiscard]] bool is_landing() const;
  /// It has come to an item that asks for the mode RTL.
  [[nodiscard]] bool wants_return() const { return leg_ == Leg::leave_for_home; }
  /// Where the camera is to look.
  [[nodiscard]] const std::optional<Position>& region_of_interest() const { return region_of_interest_; }

 private:
  /// What is being done for the current item.
  enum class Leg : std::uint8_t { none, take_off, travel, wait, turns, climb, home, leave_for_home, land };
  struct Jump {
    std::uint16_t item;
    std::uint16_t done;
  };
  static constexpr std::size_t most_pending = 64;
  static constexpr std::size_t most_jumps = 15;

  void advance(std::size_t from, const FlightContext& flight);
  [[nodiscard]] std::size_t after_jump(std::size_t item);
  void start(std::size_t item, const FlightContext& flight);
  void start_leg(const MissionItem& item, const FlightContext& flight);
  void travel(const MissionItem& item, const FlightContext& flight);
  void finish(const FlightContext& flight);
  [[nodiscard]] bool is_done(const FlightContext& flight);
  [[nodiscard]] bool has_arrived(const FlightContext& flight) const;
  [[nodiscard]] bool has_turned(const FlightContext& flight);
  void tell_done(const FlightContext& flight) const;

  // mission_actions.cpp
  void act(const FlightContext& flight);
  [[nodiscard]] bool is_held_up(const FlightContext& flight) const;
  void perform(const MissionItem& item, const FlightContext& flight);
  void look(const FlightContext& flight) const;

  std::span<const MissionItem> items_;
  std::size_t first_{};  // item 0 is home, with ArduPilot
  std::uint16_t current_{};
  bool finished_{};
  bool paused_{};
  Leg leg_{Leg::none};
  Position place_{};  // of the current item
  Position from_{};   // where its leg began
  Duration wait_{};   // at the place
  std::optional<Duration> arrived_at_{};
  double turned_{};   // rad round the place
  double bearing_{};  // rad, from the place
  std::optional<MetresPerSecond> speed_{};
  ReturnFlight return_;
  std::vector<Jump> jumps_;

  std::vector<std::uint16_t> pending_;  // what is to be done on this leg, in order
  std::optional<Duration> held_until_{};
  std::optional<double> held_beyond_m_{};  // to the place
  std::optional<Position> region_of_interest_{};
  std::optional<Radians> heading_{};
};

}  // namespace ponte::sim
