#include "web/http_options.hpp"

#include "common/failure.hpp"
#include "ponte/transport/endpoint.hpp"
#include "web/token_file.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <variant>

namespace ponte::app {
namespace {

transport::HostPort address_from(const std::string& text) {
  const auto endpoint = transport::parse_endpoint("tcpin://" + text);
  if (!endpoint)
    throw UsageError{fmt::format("--http {}: \"{}\": expected ADDRESS:PORT such as 127.0.0.1:8586", text,
                                 endpoint.error().part)};
  return std::get<transport::TcpInEndpoint>(*endpoint).local;
}

std::string from_environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string{} : value;
}

}  // namespace

void add_http_options(CLI::App& command, HttpOptions& options) {
  auto* http = command.add_option("--http", options.address, "Serve the bridge page there, e.g. 127.0.0.1:8586");
  command.add_option("--web-root", options.web_root, "Folder of the built page, instead of the one that comes with us")
      ->needs(http);
  command
      .add_option("--http-tokens", options.tokens_file,
                  "TOML file of the owner alone with command = \"...\" and watch = \"...\"")
      ->needs(http);
  auto* certificate = command.add_option("--http-cert", options.certificate, "PEM file with the certificate chain")
                          ->needs(http);
  auto* key = command.add_option("--http-key", options.key, "PEM file with the certificate's key")->needs(certificate);
  certificate->needs(key);
}

std::optional<BridgeServerOptions> bridge_server_options_from(const HttpOptions& options) {
  if (options.address.empty()) return std::nullopt;
  BridgeServerOptions result;
  result.http = {.address = address_from(options.address), .certificate = options.certificate, .key = options.key};
  result.web_root = options.web_root;
  if (!options.tokens_file.empty())
    result.tokens = read_token_file(options.tokens_file);
  else
    result.tokens = {.watch = from_environment("PONTE_HTTP_WATCH_TOKEN"),
                     .command = from_environment("PONTE_HTTP_COMMAND_TOKEN")};
  check_tokens(options.tokens_file.empty() ? "PONTE_HTTP_..._TOKEN" : options.tokens_file, result.tokens);
  return result;
}

}  // namespace ponte::app
