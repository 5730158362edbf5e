#include "ponte/transport/serial_port.hpp"

// Any baud rate needs the kernel's termios2, whose header excludes <termios.h>.
#include <asm/termbits.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/major.h>
#include <linux/serial.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace ponte::transport {
namespace {

std::string describe(const std::string& device, int error) {
  switch (error) {
    case ENOENT:
    case ENODEV:
    case ENXIO: return device + " is missing";
    case EBUSY:
    case EWOULDBLOCK: return device + " is busy: another program has it open";
    case EACCES: return device + ": permission denied; is this user in the group dialout?";
    case ENOTTY: return device + " is no serial port";
    default: return device + ": " + std::system_category().message(error);
  }
}

bool is_pseudo_terminal(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return false;
  const auto number = major(status.st_rdev);
  return number >= UNIX98_PTY_SLAVE_MAJOR && number < UNIX98_PTY_SLAVE_MAJOR + UNIX98_PTY_MAJOR_COUNT;
}

/// Keeps others out. The lock stops those who look for it, even the superuser; the mark stops everyone else. A pseudo
/// terminal would keep the mark when a program dies that made it.
bool claim(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return false;
  return is_pseudo_terminal(descriptor) || ::ioctl(descriptor, TIOCEXCL) == 0;
}

bool set_raw(int descriptor, std::uint32_t baud) {
  termios2 settings{};
  if (::ioctl(descriptor, TCGETS2, &settings) != 0) return false;
  settings.c_iflag = 0;
  settings.c_oflag = 0;
  settings.c_lflag = 0;
  settings.c_cflag = CS8 | CREAD | CLOCAL | BOTHER;
  settings.c_ispeed = baud;
  settings.c_ospeed = baud;
  settings.c_cc[VMIN] = 1;  // an empty port then says EAGAIN, not the same 0 as one that has gone
  settings.c_cc[VTIME] = 0;
  return ::ioctl(descriptor, TCSETS2, &settings) == 0;
}

/// USB converters otherwise collect bytes for up to 16 ms. Not every driver knows it, and none needs it.
void ask_for_low_latency(int descriptor) {
  serial_struct settings{};
  if (::ioctl(descriptor, TIOCGSERIAL, &settings) != 0) return;
  settings.flags = static_cast<int>(static_cast<unsigned>(settings.flags) | ASYNC_LOW_LATENCY);
  ::ioctl(descriptor, TIOCSSERIAL, &settings);
}

}  // namespace

Result<FileDescriptor, std::string> open_serial_port(const std::string& device, std::uint32_t baud) {
  FileDescriptor port{::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
  if (!port) return fail(describe(device, errno));
  if (!claim(port.get())) return fail(describe(device, errno));
  if (!set_raw(port.get(), baud)) return fail(describe(device, errno));
  ask_for_low_latency(port.get());

  termios2 settings{};
  if (::ioctl(port.get(), TCGETS2, &settings) == 0 && !baud_rates_agree(baud, settings.c_ospeed))
    return fail(fmt::format("{} cannot do {} baud; the nearest is {}", device, baud, settings.c_ospeed));
  return port;
}

}  // namespace ponte::transport
