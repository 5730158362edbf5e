#pragma once

#include "ponte/core/result.hpp"
#include "ponte/core/time.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ponte::sim {

enum class FaultKind : std::uint8_t {
  battery_low,       ///< the charge falls to a tenth: less than where both autopilots call it low
  battery_critical,  ///< the charge falls to a twenty-fifth
  gps_loss,          ///< no satellite is heard
  link_loss,         ///< nothing goes to the vehicle or comes from it
  motor,             ///< a motor stops: a copter falls, a plane glides
  reboot,            ///< the autopilot starts anew, wherever the vehicle is
};

/// What goes wrong, and when. Without a duration it lasts for ever; a battery and a reboot have none.
struct Fault {
  FaultKind kind{};
  Duration at{};  ///< since power-on
  std::optional<Duration> lasts{};
  friend bool operator==(const Fault&, const Fault&) = default;
};

/// Reads "battery-low@60s,gps-loss@90s+20s,reboot@2min": faults with their times since power-on and, if they pass, how
/// long they last, in ms, s (which may be left out) or min. The error says which part is wrong, and what was expected.
[[nodiscard]] Result<std::vector<Fault>, std::string> parse_faults(std::string_view text);

/// As `parse_faults`, of one fault whose time may be left out: then it is `now`.
[[nodiscard]] Result<Fault, std::string> parse_fault(std::string_view text, Duration now);

/// The faults of one vehicle.
class Faults {
 public:
  explicit Faults(std::vector<Fault> faults) : faults_{std::move(faults)} {}

  void add(const Fault& fault) { faults_.push_back(fault); }
  /// The fault is there at this time.
  [[nodiscard]] bool is_on(FaultKind kind, Duration now) const;
  /// It begins at `from` or later, and before `until`.
  [[nodiscard]] bool begins(FaultKind kind, Duration from, Duration until) const;

 private:
  std::vector<Fault> faults_;
};

}  // namespace ponte::sim
