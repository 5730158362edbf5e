#pragma once

#include "ponte/autopilot/patience.hpp"
#include "ponte/autopilot/peer.hpp"
#include "ponte/autopilot/voice.hpp"
#include "ponte/autopilot/wire_mission.hpp"
#include "ponte/core/time.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// The two handshakes of the mission protocol, each for one plan and one vehicle: what is asked and answered, and when
/// to repeat it. Whether the result is what somebody wanted is for `MissionClient` to say.
namespace ponte::autopilot {

struct TransferTimes {
  Patience::Limits patience{};
  /// Of silence of the vehicle, after which a transfer is given up.
  Duration silence_limit{std::chrono::seconds{30}};
  /// Beyond it, for each item: more than 30 % of loss in both directions take of ArduPilot's second between two
  /// requests.
  Duration per_item{std::chrono::seconds{5}};
  /// Before a vehicle is spoken to again that is occupied, or has ended a transfer.
  Duration pause{std::chrono::seconds{1}};
};

/// How a transfer stands.
enum class TransferState : std::uint8_t {
  running,
  done,       ///< an upload was accepted; a download is complete
  uncertain,  ///< of an upload: all was sent, and the vehicle has no transfer any more; it may have taken the plan
  refused,    ///< by a MAV_MISSION_RESULT
  occupied,   ///< the vehicle was busy with another transfer all the time
  silent,     ///< nothing came for too long, or not enough of it
  too_many,   ///< of a download: more items than are kept
};

/// What both handshakes are about: which plan of whom.
struct PlanRoute {
  Peer peer{};
  PlanType type{};
};

/// A plan on its way to the vehicle, which asks for its items one by one.
class PlanUpload {
 public:
  /// `patience` outlives it: it knows the link also from other transfers.
  PlanUpload(const TransferTimes& times, Patience& patience) : times_{times}, patience_{patience} {}

  /// Announces the plan; `items` stay where they are until it has ended.
  void begin(Timestamp now, const PlanRoute& route, std::span<const WireItem> items, Voice& voice);
  /// There is nothing that the vehicle could ask for.
  void forget() { items_ = {}; }
  /// The vehicle asks us for an item. Also after the end: a late copy of our announcement may have begun it again.
  void on_request(Timestamp now, std::uint16_t item, Voice& voice);
  /// `result` is a MAV_MISSION_RESULT.
  void on_ack(Timestamp now, std::uint8_t result);
  void on_tick(Timestamp now, Voice& voice);
  [[nodiscard]] Timestamp next_deadline() const;

  [[nodiscard]] TransferState state() const { return state_; }
  /// Whether the vehicle has ever asked for an item.
  [[nodiscard]] bool has_begun() const { return has_begun_; }
  /// The item that was sent last, which a refusal is about.
  [[nodiscard]] std::uint16_t item() const { return item_; }
  [[nodiscard]] std::uint8_t result() const { return result_; }

 private:
  [[nodiscard]] bool is_at_last_item() const { return is_sending_ && item_ + std::size_t{1} == items_.size(); }
  void announce(Timestamp now, Voice& voice);
  void announce_later(Timestamp now);
  void send_item(Timestamp now, Voice& voice);
  void end(TransferState state) { state_ = state; }

  TransferTimes times_;
  Patience& patience_;
  PlanRoute route_{};
  std::span<const WireItem> items_;
  TransferState state_{TransferState::done};
  bool is_sending_{};   ///< items, as opposed to announcing them
  bool is_repeated_{};  ///< what was sent last
  bool is_occupied_{};
  bool has_begun_{};
  std::uint16_t item_{};
  std::uint8_t result_{};
  Timestamp sent_{};
  Timestamp heard_{};
  Timestamp next_try_{};
  Timestamp end_{};
};

/// A plan on its way from the vehicle: its items are asked for, several at a time where the autopilot stands that.
class PlanDownload {
 public:
  static constexpr std::size_t item_limit = 8192;

  PlanDownload(const TransferTimes& times, Patience& patience) : times_{times}, patience_{patience} {}

  void begin(Timestamp now, const PlanRoute& route, Voice& voice);
  void on_count(Timestamp now, std::uint16_t count, std::uint32_t opaque_id, Voice& voice);
  void on_item(Timestamp now, const WireItem& item, Voice& voice);
  void on_ack(Timestamp now, std::uint8_t result);
  void on_tick(Timestamp now, Voice& voice);
  [[nodiscard]] Timestamp next_deadline() const;

  [[nodiscard]] TransferState state() const { return state_; }
  [[nodiscard]] std::uint8_t result() const { return result_; }
  /// As the vehicle gave them, once it is done.
  [[nodiscard]] const std::vector<WireItem>& items() const { return items_; }
  /// What the vehicle calls this content; 0 if it gives no name.
  [[nodiscard]] std::uint32_t opaque_id() const { return opaque_id_; }
  [[nodiscard]] std::size_t received() const { return received_; }

 private:
  /// An item that was asked for and has not come.
  struct Wanted {
    std::uint16_t item{};
    Timestamp asked{};
    bool is_repeated{};
  };
  static constexpr std::size_t window = 5;

  void list(Timestamp now, Voice& voice);
  void list_later(Timestamp now);
  void start(Timestamp now, std::uint16_t count, std::uint32_t opaque_id, Voice& voice);
  void ask(Timestamp now, Wanted& wanted, Voice& voice) const;
  void fill(Timestamp now, Voice& voice);
  void finish(Voice& voice);
  void end(TransferState state) { state_ = state; }
  /// PX4 takes any but the next item for an error, and ends the transfer.
  [[nodiscard]] bool asks_in_order() const { return route_.peer.stack == Stack::px4; }

  TransferTimes times_;
  Patience& patience_;
  PlanRoute route_{};
  std::vector<WireItem> items_;
  std::vector<Wanted> wanted_;
  std::size_t received_{};
  std::size_t next_{};  ///< the first that was never asked for
  TransferState state_{TransferState::done};
  bool is_listing_{};
  bool is_repeated_{};
  bool is_occupied_{};
  int starts_{};
  std::uint8_t result_{};
  std::uint32_t opaque_id_{};
  Timestamp sent_{};
  Timestamp heard_{};
  Timestamp next_try_{};
  Timestamp end_{};
};

}  // namespace ponte::autopilot
