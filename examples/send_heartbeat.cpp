// send_heartbeat PORT: says over UDP, to that port of this machine, that a companion computer is there.
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/codec.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  using namespace ponte;
  using namespace ponte::mavlink::autopilots;
  if (argc != 2) return 2;

  const Heartbeat heartbeat{
      .type = MAV_TYPE_ONBOARD_CONTROLLER, .autopilot = MAV_AUTOPILOT_INVALID, .system_status = MAV_STATE_ACTIVE};
  const mavlink::FrameHeader header{
      .system = mavlink::SystemId{1}, .component = mavlink::ComponentId{MAV_COMP_ID_ONBOARD_COMPUTER}, .sequence = 0};
  std::array<std::byte, mavlink::max_frame_size> frame{};
  const auto size = mavlink::encode(heartbeat, header, frame);
  if (!size) return 1;  // the message does not exist in the version of the header

  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<in_port_t>(std::atoi(argv[1])));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int link = socket(AF_INET, SOCK_DGRAM, 0);
  const auto sent = sendto(link, frame.data(), *size, 0, reinterpret_cast<sockaddr*>(&address), sizeof address);
  close(link);
  std::printf("%zd bytes sent\n", sent);
  return sent == static_cast<ssize_t>(*size) ? 0 : 1;
}
