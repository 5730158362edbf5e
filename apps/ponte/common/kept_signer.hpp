#pragma once

#include "common/log.hpp"
#include "common/mavlink_options.hpp"
#include "ponte/mavlink/signer.hpp"
#include "ponte/mavlink/signing_store.hpp"
#include "ponte/transport/file_descriptor.hpp"
#include "ponte/transport/loop.hpp"

#include <memory>
#include <string>

namespace ponte::app {

/// A signer whose time is kept in a file, so that it does not go back between two runs, whatever the clock says.
class KeptSigner {
 public:
  /// Nobody else may use the file meanwhile. Throws `Failure`.
  KeptSigner(transport::Loop& loop, const mavlink::SigningKey& key, std::string time_file, Log log);
  ~KeptSigner();
  KeptSigner(const KeptSigner&) = delete;
  KeptSigner& operator=(const KeptSigner&) = delete;

  [[nodiscard]] mavlink::Signer& signer() { return signer_; }

 private:
  struct Store {
    transport::FileDescriptor file;
    mavlink::StoredSigningTime content;
  };
  static Store open_store(const std::string& path, spdlog::logger& log);
  KeptSigner(transport::Loop& loop, const mavlink::SigningKey& key, std::string time_file, Log log, Store store);
  void store();

  std::string path_;
  Log log_;
  transport::FileDescriptor file_;
  std::size_t next_slot_;
  bool has_failed_{};
  mavlink::Signer signer_;
  transport::Timer timer_;
};

/// The signer that the options ask for; nothing without a key. Throws `Failure` or `UsageError`.
[[nodiscard]] std::unique_ptr<KeptSigner> kept_signer_from(transport::Loop& loop, const MavlinkOptions& options,
                                                           const Log& log);

}  // namespace ponte::app
