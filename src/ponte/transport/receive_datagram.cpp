#include "ponte/transport/receive_datagram.hpp"

#include <array>
#include <cerrno>
#include <cstring>

namespace ponte::transport {
namespace {

std::optional<std::uint32_t> overflow_in(msghdr& message) {
  for (auto* header = CMSG_FIRSTHDR(&message); header != nullptr; header = CMSG_NXTHDR(&message, header)) {
    if (header->cmsg_level != SOL_SOCKET || header->cmsg_type != SO_RXQ_OVFL) continue;
    std::uint32_t count{};
    std::memcpy(&count, CMSG_DATA(header), sizeof count);
    return count;
  }
  return {};
}

}  // namespace

void report_overflow(int socket) {
  const int on = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on);
}

ReceivedDatagram receive_datagram(int socket, MutableBytes buffer, void* address, socklen_t address_size) {
  alignas(cmsghdr) std::array<std::byte, CMSG_SPACE(sizeof(std::uint32_t))> control{};
  iovec place{.iov_base = buffer.data(), .iov_len = buffer.size()};
  msghdr message{};
  message.msg_name = address;
  message.msg_namelen = address_size;
  message.msg_iov = &place;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const auto size = ::recvmsg(socket, &message, MSG_DONTWAIT);
  if (size < 0) return {.error = errno};
  return {
      .size = static_cast<std::size_t>(size), .address_size = message.msg_namelen, .overflow = overflow_in(message)};
}

}  // namespace ponte::transport
