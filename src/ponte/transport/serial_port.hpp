#pragma once

#include "ponte/core/result.hpp"
#include "ponte/transport/file_descriptor.hpp"

#include <cstdint>
#include <string>

namespace ponte::transport {

/// Opens a serial port for ourselves alone: raw, 8 data bits, no parity, 1 stop bit, no flow control, modem lines
/// ignored and left alone at close. Reading and writing it do not wait. A pseudo terminal is fine too.
/// The error is one line that names the port.
[[nodiscard]] Result<FileDescriptor, std::string> open_serial_port(const std::string& device, std::uint32_t baud);

/// Whether a port that was asked for `wanted` baud and runs at `actual` is understood by the other end: UARTs bear a
/// difference of about 3 %.
[[nodiscard]] constexpr bool baud_rates_agree(std::uint32_t wanted, std::uint32_t actual) {
  const std::uint64_t difference = wanted > actual ? wanted - actual : actual - wanted;
  return difference * 100 <= std::uint64_t{wanted} * 3;
}

}  // namespace ponte::transport
