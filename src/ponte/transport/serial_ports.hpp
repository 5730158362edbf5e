#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ponte::transport {

/// A serial port of this machine.
struct SerialPort {
  std::string device;   ///< e.g. /dev/ttyACM0
  std::string by_id{};  ///< what udev calls the device, which stays the same wherever it is plugged in; or empty
  bool is_autopilot{};  ///< by the maker's name

  friend bool operator==(const SerialPort&, const SerialPort&) = default;
};

/// Whether a name from /dev/serial/by-id is that of a known maker of autopilots.
[[nodiscard]] bool looks_like_autopilot(std::string_view by_id);

/// The ports in a folder that looks like /dev, autopilots first. UARTs of the board, ttyS*, have entries whether they
/// exist or not: those are listed that `answers` returns true for.
[[nodiscard]] std::vector<SerialPort> serial_ports_in(
    const std::filesystem::path& folder, const std::function<bool(const std::filesystem::path& device)>& answers);

/// The ports of this machine. No port is opened, but for those of the board, for a moment.
[[nodiscard]] std::vector<SerialPort> serial_ports();

}  // namespace ponte::transport
