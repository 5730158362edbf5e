#include "web/router.hpp"

#include "web/gzip.hpp"

#include <fmt/format.h>
#include <openssl/sha.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <utility>

namespace ponte::app {
namespace {

using nlohmann::json;

constexpr std::string_view api = "/api/v1/";

HttpResponse not_found() { return problem(404, "not_found", "there is nothing here"); }
HttpResponse bad_request(std::string_view detail) { return problem(400, "bad_request", detail); }
HttpResponse no_content() { return {.status = 204}; }
HttpResponse wrong_method(std::string_view allowed) {
  auto response = problem(405, "bad_request", fmt::format("expected the method {}", allowed));
  response.headers.emplace_back("Allow", allowed);
  return response;
}

/// The member `key` of the body if the body is an object with these keys alone; otherwise null.
json member_of(const HttpRequest& request, std::initializer_list<std::string_view> keys, std::string_view key) {
  const auto body = json::parse(request.body, nullptr, false);
  if (!body.is_object() || body.size() != keys.size()) return {};
  const bool all = std::ranges::all_of(keys, [&](auto name) { return body.contains(name); });
  return all ? body.at(std::string{key}) : json{};
}

/// A digest for the ETag header.
std::string tag_of(std::string_view text) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), digest.data());
  return fmt::format("\"{:02x}\"", fmt::join(std::span{digest}.first(8), ""));
}

bool is_numeric_address(std::string_view host) {
  if (host.starts_with('[')) return host.ends_with(']');
  return !host.empty() && host.find_first_not_of("0123456789.") == std::string_view::npos;
}

}  // namespace

Router::Router(Access& access, const StaticFiles& files, WebActions& actions, HostNames hosts, bool is_secure)
    : access_{access}, files_{files}, actions_{actions}, hosts_{std::move(hosts)}, is_secure_{is_secure} {}

void Router::set_catalogue(const std::string& text) {
  catalogue_ = shared_text(text);
  zipped_catalogue_ = shared_text(gzip(text));
  catalogue_tag_ = tag_of(text);
}

bool Router::is_own_host(std::string_view host) const {
  const auto bracket = host.find(']');
  const auto colon = host.find(':', bracket == std::string_view::npos ? 0 : bracket);
  const auto name = host.substr(0, colon);
  return std::ranges::find(hosts_.names, name) != hosts_.names.end() ||
         (hosts_.any_address && is_numeric_address(name));
}

/// A name that leads here without being ours, or a page of somebody else that sends its visitors here.
std::optional<HttpResponse> Router::refuse_foreign(const HttpRequest& request) const {
  if (!is_own_host(request.host))
    return problem(403, "foreign_host", fmt::format("Host: expected one of {}", fmt::join(hosts_.names, ", ")));
  if (request.has_origin && request.origin != fmt::format("{}://{}", is_secure_ ? "https" : "http", request.host))
    return problem(403, "foreign_origin", "Origin: expected this server's own page");
  return std::nullopt;
}

HttpResponse Router::handle(Timestamp now, const HttpRequest& request) {
  auto refusal = refuse_foreign(request);
  auto response = refusal ? std::move(*refusal) : answer(now, request);
  protect(response);
  return response;
}

void Router::protect(HttpResponse& response) const {
  response.headers.emplace_back("X-Content-Type-Options", "nosniff");
  response.headers.emplace_back("Referrer-Policy", "no-referrer");
  response.headers.emplace_back("Content-Security-Policy",
                                "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
                                "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  const auto is_cached = [](const auto& header) { return header.first == "Cache-Control"; };
  if (std::ranges::none_of(response.headers, is_cached)) response.headers.emplace_back("Cache-Control", "no-store");
}

Result<Role, HttpResponse> Router::admit(const HttpRequest& request) {
  if (auto refusal = refuse_foreign(request)) {
    protect(*refusal);
    return fail(std::move(*refusal));
  }
  if (const auto role = access_.role_of(request.cookie)) return *role;
  auto refusal = problem(401, "no_session", "expected the cookie of a session");
  protect(refusal);
  return fail(std::move(refusal));
}

HttpResponse Router::answer(Timestamp now, const HttpRequest& request) {
  const std::string_view path = request.path;
  if (path == "/api/v1/session") return answer_session(now, request);
  const bool reads = request.method == "GET" || request.method == "HEAD";
  if (!path.starts_with("/api/")) {
    if (!reads) return wrong_method("GET");
    if (path == "/healthz") return {.type = "text/plain", .body = shared_text("ok\n")};
    if (path == "/metrics") return {.type = "text/plain; version=0.0.4", .body = shared_text(actions_.metrics())};
    return files_.get(request);
  }
  const auto role = access_.role_of(request.cookie);
  if (!role) return problem(401, "no_session", "expected the cookie of a session: POST a token to /api/v1/session");
  if (!path.starts_with(api)) return not_found();
  const auto name = path.substr(api.size());
  if (reads) return read(name, request);
  if (*role != Role::command) return problem(403, "watch_only", "expected a session with the role command");
  return change(name, request);
}

HttpResponse Router::answer_session(Timestamp now, const HttpRequest& request) {
  const auto cookie = [&](std::string_view id, std::string_view more) {
    return std::pair<std::string, std::string>{
        "Set-Cookie", fmt::format("ponte_session={}; HttpOnly; SameSite=Strict; Path=/{}{}", id,
                                  is_secure_ ? "; Secure" : "", more)};
  };
  if (request.method == "DELETE") {
    access_.close(request.cookie);
    auto response = no_content();
    response.headers.push_back(cookie("", "; Max-Age=0"));
    return response;
  }
  if (request.method != "POST") return wrong_method("POST, DELETE");
  const auto token = member_of(request, {"token"}, "token");
  if (!token.is_string()) return bad_request(R"(expected {"token": "..."})");
  const auto session = access_.open(now, token.get_ref<const std::string&>());
  if (!session) {
    if (session.error() == Access::Refusal::wrong_token) return problem(401, "wrong_token", "this token is not known");
    return problem(429, "too_often", fmt::format("expected at most {} tries a second", Access::tries_per_second));
  }
  JsonText text;
  text.begin_object().member("role", vsm::view::name_of(session->role)).end_object();
  HttpResponse response{.body = shared_text(text.text())};
  response.headers.push_back(cookie(session->id, ""));
  return response;
}

HttpResponse Router::read(std::string_view name, const HttpRequest& request) {
  if (name == "status") return {.body = actions_.status()};
  if (name == "ports") return {.body = shared_text(actions_.ports())};
  if (name == "catalogue") return catalogue(request);
  if (name == "stream") return problem(426, "bad_request", "expected a WebSocket");
  if (name != "latency-study/result") return not_found();
  constexpr std::string_view parameter = "format=";
  std::string_view format = request.query;
  if (format.empty()) format = "format=json";
  if (!format.starts_with(parameter)) return bad_request("expected format=json, csv or html");
  format.remove_prefix(parameter.size());
  if (format != "json" && format != "csv" && format != "html") return bad_request("format: expected json, csv or html");
  auto result = actions_.study_result(format);
  if (!result) return problem(404, "not_found", "no study has been finished; expected POST /api/v1/latency-study");
  HttpResponse response{.body = shared_text(std::move(*result))};
  if (format == "json") return response;
  response.type = fmt::format("text/{}; charset=utf-8", format);
  response.headers.emplace_back("Content-Disposition", fmt::format("attachment; filename=\"ponte-latency.{}\"", format));
  return response;
}

HttpResponse Router::catalogue(const HttpRequest& request) const {
  HttpResponse response{.body = catalogue_};
  response.headers = {{"ETag", catalogue_tag_}, {"Cache-Control", "private, no-cache"}, {"Vary", "Accept-Encoding"}};
  if (request.if_none_match == catalogue_tag_) {
    response.status = 304;
    response.body.reset();
  } else if (request.accepts_gzip) {
    response.body = zipped_catalogue_;
    response.headers.emplace_back("Content-Encoding", "gzip");
  }
  return response;
}

HttpResponse Router::change(std::string_view name, const HttpRequest& request) {
  if (name == "conversion") {
    if (request.method != "PUT") return wrong_method("PUT");
    const auto on = member_of(request, {"on"}, "on");
    if (!on.is_boolean()) return bad_request(R"(expected {"on": true or false})");
    actions_.convert(on.get<bool>());
    return no_content();
  }
  if (name == "vehicle-links") {
    if (request.method != "POST") return wrong_method("POST");
    const auto endpoint = member_of(request, {"endpoint"}, "endpoint");
    if (!endpoint.is_string()) return bad_request(R"(expected {"endpoint": "..."})");
    return actions_.connect(endpoint.get<std::string>());
  }
  constexpr std::string_view links = "vehicle-links/";
  if (name.starts_with(links)) {
    if (request.method != "DELETE") return wrong_method("DELETE");
    const auto text = name.substr(links.size());
    std::uint32_t number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return not_found();
    return actions_.disconnect(number) ? no_content() : problem(404, "not_found", "there is no link of that number");
  }
  if (name != "latency-study") return not_found();
  if (request.method == "DELETE") {
    actions_.stop_study();
    return no_content();
  }
  if (request.method != "POST") return wrong_method("POST, DELETE");
  const auto samples = member_of(request, {"samples", "limit_ms"}, "samples");
  const auto limit = member_of(request, {"samples", "limit_ms"}, "limit_ms");
  const bool is_good = samples.is_number_integer() && samples >= 2 && samples <= 10'000 && limit.is_number() &&
                       limit > 0 && limit <= 60'000;
  if (!is_good) return bad_request(R"(expected {"samples": 2 to 10000, "limit_ms": above 0, up to 60000})");
  if (!actions_.start_study(samples.get<std::uint64_t>(), limit.get<double>()))
    return problem(409, "busy", "a study is running; DELETE stops it");
  return {.status = 202};
}

}  // namespace ponte::app
