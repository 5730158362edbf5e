#pragma once

#include "web/access.hpp"
#include "web/http_message.hpp"
#include "web/static_files.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ponte::app {

/// What the router lets clients see and do.
class WebActions {
 public:
  virtual ~WebActions() = default;
  [[nodiscard]] virtual std::string metrics() = 0;
  [[nodiscard]] virtual vsm::view::SharedText status() = 0;
  [[nodiscard]] virtual std::string ports() = 0;  ///< a JSON array
  /// Connects to vehicles: 201 or a problem.
  [[nodiscard]] virtual HttpResponse connect(const std::string& endpoint) = 0;
  /// False: there is no such link.
  [[nodiscard]] virtual bool disconnect(std::uint32_t link) = 0;
  virtual void convert(bool on) = 0;
  /// Starts a latency study. False: one is running.
  [[nodiscard]] virtual bool start_study(std::uint64_t samples, double limit_ms) = 0;
  virtual void stop_study() = 0;
  /// The last finished study as "json", "csv" or "html"; nothing when there is none.
  [[nodiscard]] virtual std::optional<std::string> study_result(std::string_view format) = 0;
};

/// Names that a Host header may have.
struct HostNames {
  std::vector<std::string> names{};  ///< without port, IPv6 in brackets
  bool any_address{};                ///< every numeric address is ours too: no foreign site can be called so
};

/// The answers of the server, from requests: a pure function of what it is given. web/contract/openapi.yaml describes
/// them.
class Router {
 public:
  /// All of these outlive the router.
  Router(Access& access, const StaticFiles& files, WebActions& actions, HostNames hosts, bool is_secure);

  /// What does not change while the program runs.
  void set_catalogue(const std::string& json);

  [[nodiscard]] HttpResponse handle(Timestamp now, const HttpRequest& request);
  /// Whether this request may become a WebSocket, and what its client may do.
  [[nodiscard]] Result<Role, HttpResponse> admit(const HttpRequest& request);

  static constexpr std::string_view stream_path = "/api/v1/stream";

 private:
  [[nodiscard]] std::optional<HttpResponse> refuse_foreign(const HttpRequest& request) const;
  [[nodiscard]] bool is_own_host(std::string_view host) const;
  [[nodiscard]] HttpResponse answer(Timestamp now, const HttpRequest& request);
  [[nodiscard]] HttpResponse answer_session(Timestamp now, const HttpRequest& request);
  [[nodiscard]] HttpResponse read(std::string_view path, const HttpRequest& request);
  [[nodiscard]] HttpResponse change(std::string_view path, const HttpRequest& request);
  [[nodiscard]] HttpResponse catalogue(const HttpRequest& request) const;
  void protect(HttpResponse& response) const;

  Access& access_;
  const StaticFiles& files_;
  WebActions& actions_;
  HostNames hosts_;
  bool is_secure_;
  vsm::view::SharedText catalogue_;
  vsm::view::SharedText zipped_catalogue_;
  std::string catalogue_tag_;
};

}  // namespace ponte::app
