#pragma once

#include "ponte/autopilot/status_text.hpp"
#include "ponte/mavlink/parser.hpp"
#include "ponte/vsm/view/dli_table.hpp"
#include "ponte/vsm/view/event_log.hpp"
#include "ponte/vsm/view/mavlink_table.hpp"
#include "ponte/vsm/view/situation.hpp"
#include "ponte/vsm/view/stage_times.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>

/// What people watch of a VSM: the newest of everything that crosses the bridge, as the JSON of
/// web/contract/messages.schema.json.
namespace ponte::vsm::view {

/// A text that several clients share.
using SharedText = std::shared_ptr<const std::string>;

/// A text about what is new, and up to where it tells.
struct News {
  SharedText text;  ///< nothing: nothing is new
  std::uint64_t until{};
};

struct ViewConfig {
  dli::Profile profile{};
  std::string profile_name{"default"};
  Duration budget = std::chrono::milliseconds{500};  ///< what a message may take from received to sent
};

/// What went over one side of the bridge since the program started.
struct Totals {
  RateMeter rate{};
  std::uint64_t bytes{};
  std::uint64_t rejected{};  ///< pieces of received bytes that were no good message
};

enum class StudyState : std::uint8_t { none, running, done, failed };

/// How far a latency study is.
struct StudyProgress {
  StudyState state{};
  std::uint64_t samples{};  ///< wanted
  double limit_ms{};
  std::uint64_t done{};  ///< taken
  std::string detail{};  ///< why it failed, and what to do
};

/// Is fed with everything that happens on the bridge, and keeps what clients ask for. Its memory is bounded whatever it
/// is fed with. Knows no clock and no socket.
class BridgeView {
 public:
  /// Traffic is told in pieces of about this size.
  static constexpr std::size_t traffic_size = 1'000'000;

  /// The catalogue outlives the view.
  BridgeView(const dli::Catalogue& catalogue, ViewConfig config);

  void on_crossing(const Crossing& crossing);
  /// Messages that were sent because it was time to.
  void on_clock(Timestamp now, std::span<const OutgoingMessage> messages);
  /// Bytes from a vehicle link that are part of no frame. One run may come in several calls.
  void on_skipped(VehicleLinkId link, Bytes run, mavlink::SkipReason reason);
  /// A datagram from a ground station that held something else than good messages; `reason` is a literal.
  void on_refused(std::string_view reason, std::size_t bytes);
  /// What is so from now on. Links that are not in it any more are forgotten.
  void set_situation(Situation situation);
  void set_study(const StudyProgress& progress);
  void on_tick(Timestamp now);

  /// Forgets the times measured so far.
  void restart_times() { times_ = {}; }

  [[nodiscard]] EventLog& events() { return events_; }
  [[nodiscard]] const EventLog& events() const { return events_; }
  [[nodiscard]] const Situation& situation() const { return situation_; }
  [[nodiscard]] const StageTimes& times() const { return times_; }
  [[nodiscard]] const Totals& mavlink() const { return mavlink_; }
  [[nodiscard]] const Totals& dli() const { return dli_; }
  /// Grows whenever the situation changes.
  [[nodiscard]] std::uint64_t situation_revision() const { return situation_revision_; }
  /// Of the newest crossing, which is what `crossings` tells news up to.
  [[nodiscard]] std::uint64_t last_crossing() const { return last_crossing_; }
  /// Of the newest change in the tables, which is what `traffic` tells news up to.
  [[nodiscard]] std::uint64_t traffic_revision() const { return revision_; }

  /// Grows whenever the study goes on.
  [[nodiscard]] std::uint64_t study_revision() const { return study_revision_; }

  [[nodiscard]] SharedText status(Timestamp now);
  [[nodiscard]] SharedText study() const { return study_text_; }
  [[nodiscard]] SharedText timing();
  /// The newest crossings of a vehicle since that number.
  [[nodiscard]] News crossings(dli::EntityId vehicle, std::uint64_t since);
  /// The rows that changed since that revision; if they are many, those that changed first.
  [[nodiscard]] News traffic(std::uint64_t since, Timestamp now);

 private:
  enum class Side : std::uint8_t { mavlink, dli };
  using RejectKey = std::tuple<Side, VehicleLinkId, std::string_view>;
  struct Reject {
    std::uint64_t count{};
    std::uint64_t bytes{};
    std::uint64_t revision{};
  };
  /// A row of the inspector's table that has changed.
  struct Change;

  void reject(RejectKey key, std::size_t pieces, std::size_t bytes);
  void read_status_text(const Crossing& crossing);
  void add_alert(mavlink::SystemId system, WallTime time, const vehicle::Alert& alert);
  [[nodiscard]] const VehicleOnLink* vehicle_on(VehicleLinkId link, mavlink::SystemId system) const;
  void append_crossing(JsonText& json, const MavlinkKey& key, const MavlinkRow& row, StoredCrossing& crossing);

  ViewConfig config_;
  MavlinkTable mavlink_table_;
  DliTable dli_table_;
  std::map<RejectKey, Reject> rejects_;
  std::map<VehicleLinkId, mavlink::SkipReason> skipping_;  ///< why the last bytes of a link were skipped, if they were
  std::map<mavlink::SystemId, autopilot::StatusTextAssembler> status_texts_;
  EventLog events_;
  Situation situation_;
  StageTimes times_;
  Totals mavlink_;
  Totals dli_;
  std::uint64_t last_crossing_{};
  std::uint64_t revision_{};
  std::uint64_t situation_revision_{};
  std::uint64_t study_revision_{};
  WallTime wall_{};  ///< of the newest crossing
  SharedText study_text_;
  // Texts of the present tick, which clients share.
  SharedText status_text_;
  SharedText timing_text_;
  std::map<std::pair<dli::EntityId, std::uint64_t>, News> crossing_news_;
  std::map<std::uint64_t, News> traffic_news_;
};

}  // namespace ponte::vsm::view
