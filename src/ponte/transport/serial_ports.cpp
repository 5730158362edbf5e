#include "ponte/transport/serial_ports.hpp"

#include "ponte/transport/file_descriptor.hpp"

#include <fcntl.h>
#include <linux/serial.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <system_error>
#include <tuple>
#include <utility>

namespace ponte::transport {
namespace {

namespace fs = std::filesystem;

// As they stand in USB descriptors, in lower case.
constexpr auto autopilot_names = std::to_array<std::string_view>({
    "3d_robotics", "3dr",     "ardupilot", "auav",    "cuav",      "cubepilot", "cubeorange", "drotek", "fmu",
    "hex_",        "hex-",    "hextech",   "holybro", "kakute",    "matek",     "modalai",    "mro",    "nxp_fmuk66",
    "omnibus",     "pixhawk", "pixracer",  "px4",     "radiolink", "skyviper",  "speedybee",  "uvify",
});

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// The families of names, in the order in which people look for their ports; the last are those of the board.
constexpr auto families = std::to_array<std::string_view>({"ttyACM", "ttyUSB", "ttyAMA", "ttyTHS", "ttyS"});
constexpr auto board_family = families.size() - 1;

struct PortName {
  std::size_t family{};
  std::string name;

  // ttyUSB2 comes before ttyUSB10.
  friend bool operator<(const PortName& a, const PortName& b) {
    return std::tuple{a.family, a.name.size(), std::string_view{a.name}} <
           std::tuple{b.family, b.name.size(), std::string_view{b.name}};
  }
};

std::optional<PortName> port_name(std::string name) {
  for (std::size_t i = 0; i < families.size(); ++i) {
    const auto number = name.starts_with(families[i]) ? std::string_view{name}.substr(families[i].size()) : "";
    const auto is_number = !number.empty() && std::ranges::all_of(number, [](char c) { return c >= '0' && c <= '9'; });
    if (is_number) return PortName{i, std::move(name)};
  }
  return {};
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator entry{folder, error}; !error && entry != fs::directory_iterator{}; entry.increment(error))
    entries.push_back(entry->path());
  std::ranges::sort(entries);
  return entries;
}

/// From "ttyACM0" to the first name that udev has for it.
std::map<std::string, std::string> names_by_port(const fs::path& by_id) {
  std::map<std::string, std::string> names;
  for (const auto& link : entries_of(by_id)) {
    std::error_code error;
    const auto target = fs::read_symlink(link, error);
    if (!error) names.emplace(target.filename(), link.filename());
  }
  return names;
}

bool has_a_uart(const fs::path& device) {
  const FileDescriptor port{::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
  serial_struct settings{};
  return port && ::ioctl(port.get(), TIOCGSERIAL, &settings) == 0 && settings.type != PORT_UNKNOWN;
}

}  // namespace

bool looks_like_autopilot(std::string_view by_id) {
  std::string name{by_id};
  std::ranges::transform(name, name.begin(), lower);
  return std::ranges::any_of(autopilot_names, [&](auto maker) { return name.find(maker) != std::string::npos; });
}

std::vector<SerialPort> serial_ports_in(const fs::path& folder,
                                        const std::function<bool(const fs::path& device)>& answers) {
  std::vector<PortName> found;
  for (const auto& entry : entries_of(folder)) {
    auto port = port_name(entry.filename());
    if (port && (port->family != board_family || answers(entry))) found.push_back(*std::move(port));
  }
  std::ranges::sort(found, std::less{});

  const auto names = names_by_port(folder / "serial" / "by-id");
  std::vector<SerialPort> ports;
  for (const auto& port : found) {
    const auto name = names.find(port.name);
    const auto by_id = name == names.end() ? std::string{} : name->second;
    ports.push_back({folder / port.name, by_id, looks_like_autopilot(by_id)});
  }
  std::ranges::stable_partition(ports, &SerialPort::is_autopilot);
  return ports;
}

std::vector<SerialPort> serial_ports() { return serial_ports_in("/dev", has_a_uart); }

}  // namespace ponte::transport
