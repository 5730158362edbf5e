#pragma once

#include "ponte/mavlink/autopilots/mission_item_int.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/sim/flight_mode.hpp"
#include "support/world/world.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ponte::world {

using MissionItem = mavlink::autopilots::MissionItemInt;

struct PilotConfig {
  mavlink::SystemId vehicle{1};
  sim::VehicleKind kind{};
  std::vector<MissionItem> mission;  ///< as it is sent, by `seq`
};

/// A ground station that flies one mission: uploads it, reads it back, arms, starts, and watches until the vehicle is
/// disarmed again. It asks again whenever nothing comes, for as long as it takes. Written apart from ponte's own
/// services, so that they can be judged by the same vehicles.
class Pilot final : public Participant, private mavlink::FrameSink {
 public:
  explicit Pilot(PilotConfig config);

  void on_piece(Timestamp now, Port port, Bytes piece, Sender& out) override;
  void on_tick(Timestamp now, Sender& out) override;
  [[nodiscard]] std::optional<Timestamp> next_deadline() const override;

  enum class Phase : std::uint8_t {
    looking,
    uploading,
    reading_back,
    choosing_mode,
    arming,
    starting,
    flying,
    done,
    refused
  };
  [[nodiscard]] Phase phase() const { return phase_; }
  /// The flight is over, or never began.
  [[nodiscard]] bool is_over() const { return phase_ == Phase::done || phase_ == Phase::refused; }
  /// What the vehicle gave back differs from what it had accepted.
  [[nodiscard]] const std::string& difference() const { return difference_; }
  /// As the vehicle says.
  [[nodiscard]] bool is_armed() const { return is_armed_; }
  /// When the flight began; nothing before.
  [[nodiscard]] std::optional<Timestamp> started() const { return started_; }

 private:
  void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override;
  void on_heartbeat(const mavlink::FrameView& frame);
  void on_mission_request(std::uint16_t sequence);
  void on_mission_ack(std::uint8_t type);
  void on_mission_item(const MissionItem& item);
  void on_command_ack(const mavlink::FrameView& frame);
  [[nodiscard]] bool is_plane() const { return config_.kind.type == sim::AirframeType::plane; }
  void go_on_to(Phase phase);
  void act();
  void command(std::uint16_t number, const std::array<float, 3>& parameters);
  template <mavlink::Message M>
  void send(const M& message);

  PilotConfig config_;
  mavlink::Parser parser_;
  Phase phase_{Phase::looking};
  Timestamp now_{};
  Sender* out_{};  // while something arrives or is due
  Timestamp next_heartbeat_{};
  Timestamp next_try_{Timestamp::max()};
  std::uint8_t sequence_{};
  std::uint8_t confirmation_{};
  std::optional<std::uint16_t> wanted_item_{};  // that the vehicle asked for, or that we ask for
  std::vector<MissionItem> read_back_;
  std::string difference_;
  bool is_armed_{};
  std::optional<Timestamp> started_{};
};

[[nodiscard]] std::string_view name_of(Pilot::Phase phase);

}  // namespace ponte::world
