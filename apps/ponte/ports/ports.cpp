#include "ports/ports.hpp"

#include "common/json_line.hpp"

#include <fmt/format.h>

#include <memory>

namespace ponte::app {
namespace {

void run(bool json) {
  const auto ports = transport::serial_ports();
  if (!json && ports.empty()) fmt::print("no serial ports\n");
  JsonText line;
  for (const auto& port : ports) {
    if (json) {
      append_port(line, port);
      print_line(line);
    } else {
      fmt::print("{:<20} {:<10} {}\n", port.device, port.is_autopilot ? "autopilot" : "", port.by_id);
    }
  }
}

}  // namespace

void append_port(JsonText& json, const transport::SerialPort& port) {
  json.begin_object().member("device", std::string_view{port.device}).member("by_id", std::string_view{port.by_id});
  json.member("autopilot", port.is_autopilot).end_object();
}

void add_ports(CLI::App& app) {
  auto json = std::make_shared<bool>();
  auto* command = app.add_subcommand("ports", "List the serial ports, those that look like autopilots first");
  command->add_flag("--json", *json, "One JSON object per line");
  command->footer("Example:\n  ponte ports");
  command->callback([json] { run(*json); });
}

}  // namespace ponte::app
