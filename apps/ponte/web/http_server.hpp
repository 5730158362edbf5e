#pragma once

#include "ponte/transport/endpoint.hpp"
#include "ponte/transport/loop.hpp"
#include "ponte/vsm/view/client_feed.hpp"
#include "web/http_message.hpp"
#include "web/metrics.hpp"

#include <memory>
#include <string>

namespace ponte::app {

struct HttpServerOptions {
  transport::HostPort address{};  ///< numeric; port 0: the kernel chooses one
  std::string certificate{};      ///< PEM file with the chain; empty: plain HTTP
  std::string key{};              ///< PEM file
};

/// What is served.
class HttpSite {
 public:
  virtual ~HttpSite() = default;
  [[nodiscard]] virtual HttpResponse handle(Timestamp now, const HttpRequest& request) = 0;
  /// What a new WebSocket is fed from; the answer to the request instead if it may not be.
  [[nodiscard]] virtual Result<std::unique_ptr<vsm::view::ClientFeed>, HttpResponse> admit(
      const HttpRequest& request) = 0;
};

/// HTTP and WebSockets on one port. Every size and time has a limit (see web/contract/openapi.yaml), and who exceeds it
/// is answered so, or cut off.
class HttpServer {
 public:
  /// Listens from now on. Throws `Failure`. The loop and the site outlive the server; the site is asked while the loop
  /// runs, until the server's end.
  HttpServer(transport::Loop& loop, const HttpServerOptions& options, HttpSite& site);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  /// To be called every `ClientFeed::crossing_period`: WebSockets get what is due.
  void on_tick(Timestamp now);
  [[nodiscard]] ServerCounters counters() const;

 private:
  class Acceptor;

  std::shared_ptr<Acceptor> acceptor_;
};

}  // namespace ponte::app
