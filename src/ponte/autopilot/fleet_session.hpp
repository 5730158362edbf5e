#pragma once

#include "ponte/autopilot/modes.hpp"
#include "ponte/autopilot/voice.hpp"
#include "ponte/core/outbox.hpp"
#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace ponte::autopilot {

/// What is worth a line in the log.
struct FleetFact {
  enum class Kind : std::uint8_t {
    appeared,      ///< the first HEARTBEAT of an autopilot
    lost,          ///< no HEARTBEAT for `loss_limit`, or its link ended
    returned,      ///< HEARTBEAT again after a loss, on the same or another link
    rebooted,      ///< its time since boot went back
    duplicate_id,  ///< another autopilot uses the same system id; it is left out
  } kind{};
  mavlink::SystemId system{};
  mavlink::ComponentId component{};
  LinkId link{};

  friend bool operator==(const FleetFact&, const FleetFact&) = default;
};

struct FleetConfig {
  /// Who we are. Not 255, which ArduPilot takes for the ground station whose silence it answers with a failsafe: a
  /// listener must not stand in for it.
  mavlink::SystemId system{250};
  mavlink::ComponentId component{190};
  mavlink::Version version{mavlink::Version::v2};  ///< towards peers that have not shown theirs
  bool ask_for_streams{true};
};

/// The ground side of MAVLink as far as a listener needs it: finds vehicles by their HEARTBEAT, keeps them apart, says
/// who we are, answers TIMESYNC, and asks for what an autopilot does not send by itself; again after a reboot, after a
/// loss, and while nothing comes of it.
class FleetSession {
 public:
  static constexpr std::size_t vehicle_limit = 250;
  static constexpr std::size_t link_limit = 256;
  static constexpr Duration loss_limit = std::chrono::seconds{10};
  static constexpr Duration heartbeat_period = std::chrono::seconds{1};
  /// A vehicle that sends no ATTITUDE for so long is asked again.
  static constexpr Duration stream_patience = std::chrono::seconds{5};

  explicit FleetSession(FleetConfig config);

  void on_link_up(Timestamp now, LinkId link);
  /// Vehicles on it are lost at once, so that they may return on another.
  void on_link_down(LinkId link, Outbox<FleetFact>& facts);

  /// A frame with the right checksum. True: it comes from a vehicle that is followed, and should be listened to.
  bool on_frame(Timestamp now, LinkId link, const mavlink::FrameView& frame, Outbox<OutgoingFrame>& out,
                Outbox<FleetFact>& facts);
  void on_tick(Timestamp now, Outbox<OutgoingFrame>& out, Outbox<FleetFact>& facts);
  [[nodiscard]] std::optional<Timestamp> next_deadline() const;

  struct Vehicle {
    mavlink::SystemId system{};
    mavlink::ComponentId component{};
    LinkId link{};
    Stack stack{};
    std::uint8_t type{};       ///< MAV_TYPE
    std::uint8_t autopilot{};  ///< MAV_AUTOPILOT
    bool lost{};
    bool duplicate_told{};
    Timestamp last_heartbeat{};
    Timestamp last_attitude{};
    Timestamp last_request{};
    std::optional<std::uint32_t> newest_boot_ms{};
    std::optional<std::uint32_t> boot_ms_before_reboot{};
  };
  /// What else is said on a link goes through this, so that all frames are numbered together; nothing for a link that
  /// is not up.
  [[nodiscard]] std::optional<Voice> voice(LinkId link, Outbox<OutgoingFrame>& out);
  /// Whether this system id is that of a vehicle.
  [[nodiscard]] bool follows(mavlink::SystemId system) const;
  /// By system id, ascending.
  [[nodiscard]] const std::vector<Vehicle>& vehicles() const { return vehicles_; }

 private:
  struct Link {
    LinkId id{};
    mavlink::FrameSender sender;
    bool has_signed{};
  };

  Vehicle* find(mavlink::SystemId system);
  Link* find(LinkId link);
  /// What a HEARTBEAT of any version says of its sender, in the numbers of MAVLink 1.
  struct Announcement {
    std::uint8_t autopilot{};
    std::uint8_t type{};
  };

  static std::optional<Announcement> announcement_in(const mavlink::FrameView& frame);
  bool on_heartbeat(Timestamp now, LinkId link, const mavlink::FrameView& frame, const Announcement& announcement,
                    Outbox<OutgoingFrame>& out, Outbox<FleetFact>& facts);
  static void note_version(Link& link, const mavlink::FrameView& frame);
  void on_system_time(Timestamp now, Vehicle& vehicle, const mavlink::FrameView& frame, Outbox<OutgoingFrame>& out,
                      Outbox<FleetFact>& facts);
  void tell_duplicate(Vehicle& vehicle, LinkId link, Outbox<FleetFact>& facts);
  void answer_timesync(Timestamp now, LinkId link, const mavlink::FrameView& frame, Outbox<OutgoingFrame>& out);
  void ask(Timestamp now, Vehicle& vehicle, Outbox<OutgoingFrame>& out);
  static void ask_v09(const Vehicle& vehicle, Voice& peer);
  static void send_heartbeat(Voice peer);

  FleetConfig config_;
  std::vector<Vehicle> vehicles_;
  std::vector<Link> links_;
  std::optional<Timestamp> next_heartbeat_;
};

}  // namespace ponte::autopilot
