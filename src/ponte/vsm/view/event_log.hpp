#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/core/time.hpp"
#include "ponte/dli/entity_id.hpp"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace ponte::vsm::view {

enum class EventCode : std::uint8_t {
  link_up,
  link_down,
  vehicle_found,
  vehicle_lost,
  vehicle_returned,
  vehicle_rebooted,
  duplicate_id,
  status_text,
  conversion_on,
  conversion_off,
  study_done,
  study_failed,
};
enum class Severity : std::uint8_t { info, warning, error };

struct Event {
  WallTime time{};
  EventCode code{};
  Severity severity{};
  std::optional<dli::EntityId> vehicle{};
  std::string text{};  ///< details for people
};

/// What happened, numbered from 1 on. The newest are kept.
class EventLog {
 public:
  static constexpr std::size_t capacity = 1024;
  static constexpr std::uint64_t shown_to_newcomers = 200;
  static constexpr std::size_t text_size_max = 256;  ///< the rest of a longer text is left out

  void add(Event event);

  /// Of the newest event; 0 before the first.
  [[nodiscard]] std::uint64_t last() const { return last_; }
  /// Of the oldest event that is kept; `last() + 1` before the first.
  [[nodiscard]] std::uint64_t first() const { return last_ + 1 - events_.size(); }
  /// Where somebody begins who has just come.
  [[nodiscard]] std::uint64_t first_for_newcomers() const {
    return last_ + 1 - std::min<std::uint64_t>(events_.size(), shown_to_newcomers);
  }

  /// Appends the object `{"kind":"events", ...}` of web/contract/messages.schema.json, with the events from number
  /// `from` on, which is at least `first()`.
  void append_from(JsonText& json, std::uint64_t from) const;

 private:
  std::deque<Event> events_;  ///< the last one has the number `last_`
  std::uint64_t last_{};
};

}  // namespace ponte::vsm::view
