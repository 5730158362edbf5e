#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/transport/serial_ports.hpp"

#include <CLI/App.hpp>

namespace ponte::app {

/// `ponte ports`: serial ports that look like autopilots.
void add_ports(CLI::App& app);

/// Appends `{"device":"/dev/ttyACM0","by_id":"...","autopilot":true}`.
void append_port(JsonText& json, const transport::SerialPort& port);

}  // namespace ponte::app
