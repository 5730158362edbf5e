#pragma once

#include "web/bridge_server.hpp"

#include <CLI/App.hpp>

#include <optional>
#include <string>

namespace ponte::app {

/// What a command line says of the bridge page's server.
struct HttpOptions {
  std::string address;  ///< ADDRESS:PORT; empty: no server
  std::string web_root;
  std::string tokens_file;
  std::string certificate;
  std::string key;
};

void add_http_options(CLI::App& command, HttpOptions& options);

/// Nothing when no server is wanted. Tokens come from the file, or from the environment: PONTE_HTTP_COMMAND_TOKEN and
/// PONTE_HTTP_WATCH_TOKEN. Throws `Failure` or `UsageError`.
[[nodiscard]] std::optional<BridgeServerOptions> bridge_server_options_from(const HttpOptions& options);

}  // namespace ponte::app
