#pragma once

#include "ponte/mavlink/frame.hpp"
#include "ponte/vehicle/vocabulary.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace ponte::autopilot {

/// What the mission on board a vehicle is, known by listening to the transfers between it and any ground station.
class MissionCopy {
 public:
  /// A mission with more items is not kept.
  static constexpr std::size_t item_limit = 4096;

  /// A message of the mission protocol that the vehicle sent.
  void on_vehicle_message(const mavlink::FrameView& frame);
  /// One that a ground station sent to the vehicle.
  void on_station_message(const mavlink::FrameView& frame);

  /// In ArduPilot item 0 is home and no waypoint; elsewhere it is the first waypoint.
  void set_first_item_is_home(bool is_home) { first_item_is_home_ = is_home; }

  /// The leg being flown, as far as it is known: from the item last reached to the current one, and the one after it.
  [[nodiscard]] vehicle::Leg leg(std::optional<Metres> home_altitude_msl) const;
  /// MAV_CMD of the current item; nothing when it is not known.
  [[nodiscard]] std::optional<std::uint16_t> current_command() const;

 private:
  struct Item {
    bool known{};
    std::uint16_t command{};
    std::uint8_t frame{};
    float param1{};
    float param2{};
    std::optional<Radians> latitude{};
    std::optional<Radians> longitude{};
    float z{};
  };

  struct NumberedItem {
    std::uint16_t sequence{};
    Item item{};
  };

  [[nodiscard]] static std::optional<NumberedItem> item_in(const mavlink::FrameView& frame);
  void on_answer(std::uint8_t result, std::uint8_t mission_type);
  [[nodiscard]] const Item* find(std::size_t sequence) const;
  [[nodiscard]] std::optional<vehicle::Waypoint> waypoint(std::size_t sequence,
                                                          std::optional<Metres> home_altitude_msl) const;
  [[nodiscard]] std::optional<std::size_t> following(std::size_t sequence) const;

  std::vector<Item> items_;     ///< on board
  std::vector<Item> incoming_;  ///< of an upload, on board when the vehicle has accepted it
  bool uploading_{};            ///< a station sends items, and the vehicle has not answered yet
  bool clearing_{};             ///< a station wants the mission cleared, and the vehicle has not answered yet
  bool first_item_is_home_{};
  std::optional<std::uint16_t> current_;
  std::optional<std::uint16_t> reached_;
};

}  // namespace ponte::autopilot
