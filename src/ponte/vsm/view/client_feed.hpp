#pragma once

#include "ponte/vsm/view/bridge_view.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ponte::vsm::view {

/// May a client change something, or only see it?
enum class Role : std::uint8_t { watch, command };
[[nodiscard]] std::string_view name_of(Role role);

/// What a client says it wants to see.
struct WatchRequest {
  std::optional<dli::EntityId> vehicle{};  ///< whose crossings; nothing: nobody's
  bool traffic{};

  friend bool operator==(const WatchRequest&, const WatchRequest&) = default;
};

/// Reads a message of a client; the error says, for people, what was wrong and what was expected.
[[nodiscard]] Result<WatchRequest, std::string> parse_watch_request(std::string_view text);

/// Decides what one client is sent next. It keeps no queue: it knows up to where the client has been told, and makes
/// the next message when the client is ready to take it. So a slow client is told less often, of the newest; events,
/// status and study reach it all the same.
class ClientFeed {
 public:
  static constexpr Duration crossing_period = std::chrono::milliseconds{66};
  static constexpr Duration traffic_period = std::chrono::milliseconds{500};
  static constexpr Duration second = std::chrono::seconds{1};
  static constexpr std::size_t message_size_max = 1024;  ///< of what a client may send
  static constexpr unsigned messages_per_second = 20;    ///< of what a client may send

  /// The view outlives the feed. `has_session` tells whether the role comes from a token.
  ClientFeed(BridgeView& view, Role role, bool has_session, std::string_view version);

  /// A message of the client. False: they come too often, and the connection should be closed.
  [[nodiscard]] bool on_message(Timestamp now, std::string_view text);
  /// To be called every `crossing_period`: more telemetry becomes due. What was due already and has news, and was not
  /// taken, is counted as dropped.
  void on_tick(Timestamp now);
  /// What to send now; nothing when nothing is due.
  [[nodiscard]] SharedText take(Timestamp now);
  /// The client has been so slow that events are gone which it was not told of.
  [[nodiscard]] bool has_lost_events() const { return next_event_ < view_->events().first(); }

  /// Telemetry messages that were due before the one before them was taken.
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  /// Telemetry of one kind: when it is due, and up to where it has been told.
  struct Stream {
    Duration period;
    Timestamp next{};
    bool is_due{};
    std::uint64_t since{};
  };

  void make_due(Stream& stream, Timestamp now, bool has_news);
  [[nodiscard]] SharedText take_state(Timestamp now);
  [[nodiscard]] SharedText take_telemetry(Timestamp now);

  BridgeView* view_;
  std::string hello_;
  WatchRequest request_{};
  std::string refusal_;
  Stream crossings_{crossing_period};
  Stream traffic_{traffic_period};
  Stream timing_{second};
  Timestamp next_status_{};
  std::uint64_t told_situation_{};
  std::uint64_t told_study_{};
  std::uint64_t next_event_{};
  std::uint64_t dropped_{};
  std::uint64_t told_dropped_{};
  Timestamp next_dropped_{};
  Timestamp second_began_{};
  unsigned messages_this_second_{};
};

}  // namespace ponte::vsm::view
