#pragma once

#include "ponte/autopilot/plan_transfer.hpp"
#include "ponte/core/id.hpp"
#include "ponte/core/outbox.hpp"
#include "ponte/core/result.hpp"
#include "ponte/mavlink/autopilots/mission_current.hpp"
#include "ponte/mavlink/frame.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace ponte::autopilot {

using MissionRequestId = Id<struct MissionRequestTag, std::uint32_t>;

/// Why a request cannot even be started.
enum class MissionRefusal : std::uint8_t {
  busy,              ///< with another request
  too_many_items,    ///< more than `PlanDownload::item_limit`, which could not be read back
  needs_mavlink_2,   ///< MAVLink 1 carries missions only, neither fences nor rally points
  not_in_mavlink_09  ///< which is spoken on this link
};

/// Why a request has failed.
enum class MissionFailure : std::uint8_t {
  none,
  refused,     ///< by the vehicle; `result` says why, and `item` is about which
  occupied,    ///< somebody else transfers a plan, or it is being flown
  silent,      ///< the vehicle did not answer, or took too long
  differs,     ///< what is on board is not what was sent; `item` is the first that differs
  too_many,    ///< there are more items on board than `PlanDownload::item_limit`
  unverified,  ///< the vehicle has taken it, but it could not be read back
};

/// What is on board after an upload that has failed.
enum class PlanOnBoard : std::uint8_t {
  as_requested,
  unchanged,  ///< the plan that was there before
  restored,   ///< likewise, put back since this autopilot had overwritten it
  unknown,    ///< perhaps a mixture of both
};

/// What has become of a request. Each ends in exactly one fact that is no `progress`.
struct MissionFact {
  enum class Kind : std::uint8_t { progress, uploaded, downloaded, cleared, current_set, failed } kind{};
  MissionRequestId request{};
  PlanType type{};
  std::uint16_t done{};      ///< of `progress`: items of this transfer so far
  std::uint16_t total{};     ///< of `progress`
  bool was_on_board{};       ///< of `uploaded`: nothing was sent, as the vehicle had it already
  MissionFailure failure{};  ///< of `failed`
  std::uint8_t result{};     ///< of `refused`: MAV_MISSION_RESULT
  std::uint16_t item{};      ///< of the plan as it was transferred, from 0
  PlanOnBoard plan{};        ///< of `failed`, if it was an upload or to clear
  friend bool operator==(const MissionFact&, const MissionFact&) = default;
};

/// Transfers missions, fences and rally points to and from one vehicle, one request at a time. An upload is done when
/// it has been read back and compared as this autopilot keeps plans. A vehicle that has a plan already gets nothing;
/// one that overwrites its plan item by item (ArduPilot) gets the old one back when an upload fails and the old one is
/// known.
class MissionClient {
 public:
  /// Uploads that are begun anew when something else was read back, before it is said to have failed.
  static constexpr int most_attempts = 3;

  explicit MissionClient(const Peer& peer, const TransferTimes& times = {});
  MissionClient(const MissionClient&) = delete;
  MissionClient& operator=(const MissionClient&) = delete;

  // Requests; the first message is sent at once, the rest follows from what is handed in below.

  /// No items: the plan is cleared by uploading nothing, which both autopilots allow also where they refuse `clear`.
  Result<MissionRequestId, MissionRefusal> upload(Timestamp now, PlanType type, std::vector<WireItem> items,
                                                  Voice& voice);
  /// As `upload`, of a plan that was sent in another way (`pack_plan`): it is read back first, and uploaded only if it
  /// is not on board.
  Result<MissionRequestId, MissionRefusal> confirm(Timestamp now, PlanType type, std::vector<WireItem> items,
                                                   Voice& voice);
  /// Then `plan` has it.
  Result<MissionRequestId, MissionRefusal> download(Timestamp now, PlanType type, Voice& voice);
  Result<MissionRequestId, MissionRefusal> clear(Timestamp now, PlanType type, Voice& voice);
  /// Goes on with this item of the mission as it is transferred (ArduPilot's 0 is home).
  Result<MissionRequestId, MissionRefusal> set_current(Timestamp now, std::uint16_t item, Voice& voice);

  /// A frame of the vehicle's system, with the right checksum.
  void on_message(Timestamp now, const mavlink::FrameView& frame, Voice& voice, Outbox<MissionFact>& facts);
  void on_tick(Timestamp now, Voice& voice, Outbox<MissionFact>& facts);
  /// The vehicle has started anew: what was known is not known any more, and a transfer begins again.
  void on_reboot(Timestamp now);
  [[nodiscard]] std::optional<Timestamp> next_deadline() const;

  [[nodiscard]] bool is_busy() const { return step_ != Step::idle; }
  /// The plan on board as it was last read; null if it is not known, or if it may have changed since.
  [[nodiscard]] const std::vector<WireItem>* plan(PlanType type) const;

 private:
  enum class Step : std::uint8_t { idle, telling, beginning_anew, uploading, clearing, reading, setting };
  enum class Aim : std::uint8_t { upload, clear, download, set_current };

  struct Known {
    bool is_valid{};
    std::vector<WireItem> read{};  ///< back from the vehicle
    std::vector<WireItem> sent{};  ///< what it was sent as, if we sent it
    std::uint32_t opaque_id{};     ///< 0: the vehicle gives none
  };

  [[nodiscard]] std::optional<MissionRefusal> reason_not_to(PlanType type, const Voice& voice) const;
  MissionRequestId begin(Aim aim, PlanType type);
  [[nodiscard]] Known& known() { return known_[static_cast<std::size_t>(route_.type)]; }
  [[nodiscard]] bool changes_plan() const { return aim_ == Aim::upload || aim_ == Aim::clear; }

  void attempt(Timestamp now, Voice& voice);
  void read_back(Timestamp now, Voice& voice);
  void send_request(Timestamp now, Voice& voice);
  void begin_anew(Timestamp now, Voice& voice, Outbox<MissionFact>& facts);
  void repeat(Timestamp now, Voice& voice, Outbox<MissionFact>& facts);

  // mission_client_messages.cpp
  void on_request(Timestamp now, std::uint16_t item, Voice& voice, Outbox<MissionFact>& facts);
  void on_ack(Timestamp now, std::uint8_t result, Voice& voice, Outbox<MissionFact>& facts);
  void on_current(Timestamp now, const mavlink::autopilots::MissionCurrent& current, Outbox<MissionFact>& facts);
  void note_foreign(std::uint8_t mission_type);
  void go_on(Timestamp now, Voice& voice, Outbox<MissionFact>& facts);
  void on_upload_end(Timestamp now, Voice& voice, Outbox<MissionFact>& facts);
  void on_read(Timestamp now, Voice& voice, Outbox<MissionFact>& facts);
  void examine(Timestamp now, Voice& voice, Outbox<MissionFact>& facts);
  void fail_with(Timestamp now, MissionFact failure, Voice& voice, Outbox<MissionFact>& facts);
  void tell_progress(std::size_t done, std::size_t total, Outbox<MissionFact>& facts);
  void tell(MissionFact fact, Outbox<MissionFact>& facts);

  PlanRoute route_;
  TransferTimes times_;
  Patience patience_;
  PlanUpload upload_;
  PlanDownload download_;
  std::array<Known, plan_types> known_;
  std::vector<WireItem> wanted_;  ///< what is to be on board
  Step step_{Step::idle};
  Aim aim_{};
  MissionRequestId request_{};
  int attempts_{};
  bool was_valid_{};                    ///< what was known before the request
  std::uint16_t told_{};                ///< the progress that was told last
  std::optional<MissionFact> failure_;  ///< to be told when the old plan has been put back
  std::uint16_t current_{};             ///< to be set
  Timestamp asked_{};                   ///< of what is asked in one message: when, the first time, and the next
  Timestamp since_{};
  Timestamp next_try_{};
};

}  // namespace ponte::autopilot
