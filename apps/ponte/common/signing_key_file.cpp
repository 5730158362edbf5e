#include "common/signing_key_file.hpp"

#include "common/failure.hpp"
#include "ponte/transport/file_descriptor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace ponte::app {
namespace {

constexpr std::size_t size_max = 1024;

[[noreturn]] void give_up(const std::string& path, const char* reason) {
  throw Failure{fmt::format("{}: {}", path, reason)};
}

}  // namespace

mavlink::SigningKey read_signing_key_file(const std::string& path) {
  const transport::FileDescriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0) give_up(path, std::strerror(errno));
  if (!S_ISREG(status.st_mode)) give_up(path, "is no file");
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    give_up(path, "others may use it; expected a file of its owner alone: chmod 600");

  std::array<std::byte, size_max + 1> content{};
  const auto size = ::read(file.get(), content.data(), content.size());
  if (size < 0) give_up(path, std::strerror(errno));
  const auto used = static_cast<std::size_t>(size);
  auto key = used > size_max ? std::nullopt : mavlink::read_signing_key(Bytes{content}.first(used));
  mavlink::wipe(content);
  if (!key) give_up(path, "no signing key; expected 32 bytes, 64 hex digits or passphrase=WORDS");
  return *std::move(key);
}

}  // namespace ponte::app
