#include "common/kept_signer.hpp"

#include "common/failure.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

namespace ponte::app {
namespace {

using namespace std::chrono_literals;

// The system may take half a minute more until the bytes are on the disk.
constexpr auto store_period = 20s;

}  // namespace

KeptSigner::KeptSigner(transport::Loop& loop, const mavlink::SigningKey& key, std::string time_file, Log log)
    : KeptSigner{loop, key, time_file, log, open_store(time_file, *log)} {}

KeptSigner::KeptSigner(transport::Loop& loop, const mavlink::SigningKey& key, std::string time_file, Log log,
                       Store store)
    : path_{std::move(time_file)},
      log_{std::move(log)},
      file_{std::move(store.file)},
      next_slot_{store.content.next_slot},
      signer_{key, store.content.time},
      timer_{loop, [this](Timestamp now) {
               this->store();
               timer_.set(now + store_period);
             }} {
  timer_.set(loop.now());
}

KeptSigner::~KeptSigner() {
  store();
  ::fdatasync(file_.get());
}

KeptSigner::Store KeptSigner::open_store(const std::string& path, spdlog::logger& log) {
  const auto give_up = [&](const std::string& reason) { throw Failure{fmt::format("{}: {}", path, reason)}; };
  transport::FileDescriptor file{::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR)};
  if (!file) give_up(std::strerror(errno));
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0)
    give_up("another program keeps the time of its signatures there; expected --signing-time with a file of our own");
  std::array<std::byte, mavlink::signing_store_size + 1> bytes{};
  const auto size = ::read(file.get(), bytes.data(), bytes.size());
  if (size < 0) give_up(std::strerror(errno));
  const auto used = static_cast<std::size_t>(size);
  if (used == bytes.size()) give_up("is no file with the time of signatures");
  const auto content = mavlink::read_signing_store(Bytes{bytes}.first(used));
  if (content.damaged && used == mavlink::signing_store_size)
    log.warn("{}: one time was not written to its end, the one before counts", path);
  return {std::move(file), content};
}

void KeptSigner::store() {
  const auto slot = mavlink::write_signing_slot(signer_.time());
  const auto at = static_cast<off_t>(next_slot_ * slot.size());
  if (::pwrite(file_.get(), slot.data(), slot.size(), at) == static_cast<ssize_t>(slot.size())) {
    next_slot_ = (next_slot_ + 1) % mavlink::signing_slot_count;
    has_failed_ = false;
  } else if (!std::exchange(has_failed_, true)) {
    log_->warn("{}: the time of signatures cannot be written: {}", path_, std::strerror(errno));
  }
}

std::unique_ptr<KeptSigner> kept_signer_from(transport::Loop& loop, const MavlinkOptions& options, const Log& log) {
  const auto key = signing_key_from(options);
  if (!key) return nullptr;
  auto time_file = options.time_file;
  if (time_file.empty()) {
    if (options.key_file.empty())
      throw UsageError{"PONTE_SIGNING_KEY: expected --signing-time FILE too, where the time of signatures is kept"};
    time_file = options.key_file + ".time";
  }
  return std::make_unique<KeptSigner>(loop, *key, std::move(time_file), log);
}

}  // namespace ponte::app
