#pragma once

#include "ponte/autopilot/status_text.hpp"
#include "ponte/core/text.hpp"
#include "ponte/core/time.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace ponte::autopilot {

/// The newest texts of one vehicle: when it refuses something, it says why by STATUSTEXT, a little before or after.
class RecentTexts {
 public:
  void on_text(Timestamp now, const mavlink::autopilots::Statustext& text);
  void on_tick(Timestamp now);
  [[nodiscard]] std::optional<Timestamp> next_deadline() const { return assembler_.next_deadline(); }
  void forget();

  /// What has been said since then, oldest first, "; " in between; too much is cut.
  [[nodiscard]] Text<159> since(Timestamp time) const;

 private:
  struct Entry {
    Timestamp time{};
    Text<79> text;
  };

  void keep(Timestamp now, const vehicle::Alert& alert);

  StatusTextAssembler assembler_;
  std::array<Entry, 4> entries_{};  // oldest first
};

}  // namespace ponte::autopilot
