#pragma once

#include "ponte/core/bytes.hpp"

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace ponte::transport {

/// A datagram that was received, or that there was none.
struct ReceivedDatagram {
  int error{};                              ///< of the system, e.g. EAGAIN; 0: there was one
  std::size_t size{};                       ///< of what is in the buffer now
  socklen_t address_size{};                 ///< of what is in the address now
  std::optional<std::uint32_t> overflow{};  ///< how many the socket has had to drop ever, if it has had to
};

/// Makes the system tell the overflow.
void report_overflow(int socket);

/// Receives without waiting. Bytes beyond the end of `buffer` are lost.
[[nodiscard]] ReceivedDatagram receive_datagram(int socket, MutableBytes buffer, void* address, socklen_t address_size);

}  // namespace ponte::transport
