#include "ponte/transport/pty.hpp"

#include "ponte/transport/device_link.hpp"
#include "ponte/transport/file_descriptor.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <system_error>
#include <utility>

namespace ponte::transport {
namespace {

namespace fs = std::filesystem;

constexpr auto look_for_somebody_every = std::chrono::milliseconds{20};

std::string last_error() { return std::system_category().message(errno); }

/// A symbolic link that is removed when its owner goes, unless another has taken its place.
class SymbolicLink {
 public:
  SymbolicLink(fs::path path, fs::path target) : path_{std::move(path)}, target_{std::move(target)} {}
  ~SymbolicLink() {
    std::error_code error;
    if (fs::read_symlink(path_, error) == target_ && !error) fs::remove(path_, error);
  }
  SymbolicLink(const SymbolicLink&) = delete;
  SymbolicLink& operator=(const SymbolicLink&) = delete;

 private:
  fs::path path_;
  fs::path target_;
};

FileDescriptor open_other_end(const std::string& device) {
  return FileDescriptor{::open(device.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
}

/// Our end of the terminal, and the name by which others find theirs.
class Terminal {
 public:
  Terminal(FileDescriptor master, const fs::path& path, std::string device)
      : master_{std::move(master)}, device_{std::move(device)}, link_{path, device_} {}

  /// A descriptor of our end; nothing while nobody has the other open.
  FileDescriptor open() {
    if (somebody_has_it_open()) {
      is_used_ = true;
      return FileDescriptor{::fcntl(master_.get(), F_DUPFD_CLOEXEC, 0)};
    }
    // Nobody is to read later what was meant for those who have left. Only from the other end can it be taken away.
    if (std::exchange(is_used_, false)) {
      const auto other_end = open_other_end(device_);
      ::tcflush(other_end.get(), TCIFLUSH);
    }
    return {};
  }

 private:
  [[nodiscard]] bool somebody_has_it_open() const {
    pollfd request{.fd = master_.get(), .events = POLLIN, .revents = 0};
    return ::poll(&request, 1, 0) >= 0 && (request.revents & POLLHUP) == 0;
  }

  FileDescriptor master_;
  std::string device_;
  SymbolicLink link_;
  bool is_used_{};
};

Result<std::string, std::string> unlock(const FileDescriptor& master) {
  std::array<char, 64> device{};
  if (!master || ::grantpt(master.get()) != 0 || ::unlockpt(master.get()) != 0 ||
      ::ptsname_r(master.get(), device.data(), device.size()) != 0)
    return fail("no pseudo terminal to be had: " + last_error());
  return std::string{device.data()};
}

/// As if nothing were between the two ends: no echo, no lines. It stays so when everybody has closed it. And having
/// been opened once, the terminal says from now on whether somebody has it open.
Result<void, std::string> make_raw(const std::string& device) {
  const auto other_end = open_other_end(device);
  termios settings{};
  if (!other_end || ::tcgetattr(other_end.get(), &settings) != 0) return fail(device + ": " + last_error());
  ::cfmakeraw(&settings);
  if (::tcsetattr(other_end.get(), TCSANOW, &settings) != 0) return fail(device + ": " + last_error());
  return {};
}

Result<void, std::string> link_to(const std::string& device, const fs::path& path) {
  std::error_code error;
  const auto old = fs::read_symlink(path, error);
  if (!error && old.native().starts_with("/dev/pts/")) fs::remove(path, error);
  fs::create_symlink(device, path, error);
  if (error) return fail("cannot make " + path.native() + ": " + error.message());
  return {};
}

Result<std::shared_ptr<Terminal>, std::string> make_terminal(const std::string& path) {
  FileDescriptor master{::open("/dev/ptmx", O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
  const auto device = unlock(master);
  if (!device) return fail(device.error());
  if (const auto raw = make_raw(*device); !raw) return fail(raw.error());
  if (const auto linked = link_to(*device, path); !linked) return fail(linked.error());
  return std::make_shared<Terminal>(std::move(master), path, *device);
}

}  // namespace

Result<std::unique_ptr<Link>, OpenError> open_pty(Loop& loop, const std::string& path, LinkHandler& handler,
                                                  const LinkOptions& options) {
  const auto endpoint = "pty://" + path;
  auto terminal = make_terminal(path);
  if (!terminal) return fail(OpenError{endpoint, terminal.error()});

  const auto nobody = "nobody has " + path + " open";
  auto open = [terminal = *std::move(terminal), nobody]() -> Result<FileDescriptor, std::string> {
    auto descriptor = terminal->open();
    if (!descriptor) return fail(nobody);
    return descriptor;
  };
  auto pty_options = options;
  pty_options.reconnect = true;
  pty_options.retry_first = pty_options.retry_longest = look_for_somebody_every;
  return make_device_link(loop, {endpoint, path, std::move(open), nobody}, handler, pty_options);
}

}  // namespace ponte::transport
