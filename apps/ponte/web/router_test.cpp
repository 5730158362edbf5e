#include "web/router.hpp"

#include "web/test_site.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace ponte::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Tokens tokens{.watch = "watch-token-watch", .command = "command-token-command"};

/// A router on 127.0.0.1:8586, and requests to it.
class Site {
 public:
  explicit Site(const Tokens& its_tokens = {}, HostNames hosts = {.names = {"localhost", "127.0.0.1", "[::1]"}})
      : access{its_tokens, [this] { return std::to_string(++sessions); }},
        router{access, files, actions, std::move(hosts), false} {
    router.set_catalogue(R"({"mavlink":{}})");
  }

  HttpResponse ask(const HttpRequest& request) { return router.handle({}, request); }
  static HttpRequest request(std::string method, std::string path, std::string body = {}) {
    return {.method = std::move(method), .path = std::move(path), .host = "127.0.0.1:8586", .body = std::move(body)};
  }
  HttpResponse ask(std::string method, std::string path, std::string body = {}) {
    return ask(request(std::move(method), std::move(path), std::move(body)));
  }
  HttpResponse ask_as(const std::string& token, std::string method, std::string path, std::string body = {}) {
    auto question = request(std::move(method), std::move(path), std::move(body));
    question.cookie = "ponte_session=" + access.open({}, token)->id;
    return ask(question);
  }

  int sessions{};
  Access access;
  StaticFiles files;
  testing::RecordedActions actions;
  Router router;
};

std::string header(const HttpResponse& response, std::string_view name) {
  for (const auto& [key, value] : response.headers)
    if (key == name) return value;
  return {};
}

std::string code(const HttpResponse& response) { return nlohmann::json::parse(response.text())["code"]; }

TEST(Router, AnswersWhatNeedsNoSession) {
  Site site{tokens};
  EXPECT_EQ(site.ask("GET", "/healthz").text(), "ok\n");
  EXPECT_EQ(site.ask("GET", "/metrics").text(), "metrics\n");
  EXPECT_EQ(site.ask("GET", "/").status, 404U) << "there are no files here";
  EXPECT_EQ(site.ask("POST", "/healthz").status, 405U);
}

TEST(Router, EveryAnswerIsProtected) {
  Site site;
  for (const auto* path : {"/", "/healthz", "/api/v1/status", "/api/v1/nothing"}) {
    const auto response = site.ask("GET", path);
    EXPECT_EQ(header(response, "X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(header(response, "Referrer-Policy"), "no-referrer");
    EXPECT_THAT(header(response, "Content-Security-Policy"), HasSubstr("frame-ancestors 'none'"));
    EXPECT_THAT(header(response, "Content-Security-Policy"), Not(HasSubstr("unsafe")));
    EXPECT_EQ(header(response, "Cache-Control"), "no-store");
  }
}

TEST(Router, RefusesForeignHostsAndOrigins) {
  Site site;
  for (const auto* host : {"", "evil.example", "127.0.0.1.evil.example", "evil.example:8586", "10.0.0.1:8586"}) {
    auto request = Site::request("GET", "/healthz");
    request.host = host;
    EXPECT_EQ(code(site.ask(request)), "foreign_host") << host;
  }
  for (const auto* host : {"localhost", "localhost:8586", "127.0.0.1", "[::1]:8586"}) {
    auto request = Site::request("GET", "/healthz");
    request.host = host;
    EXPECT_EQ(site.ask(request).status, 200U) << host;
  }
  for (const auto* origin : {"", "null", "http://evil.example", "http://127.0.0.1:80", "https://127.0.0.1:8586"}) {
    auto request = Site::request("PUT", "/api/v1/conversion", R"({"on":true})");
    request.has_origin = true;
    request.origin = origin;
    EXPECT_EQ(code(site.ask(request)), "foreign_origin") << origin;
    request.method = "GET";
    request.path = "/api/v1/stream";
    EXPECT_EQ(site.router.admit(request).error().status, 403U) << origin;
  }
  EXPECT_THAT(site.actions.done, IsEmpty());
  auto request = Site::request("PUT", "/api/v1/conversion", R"({"on":true})");
  request.has_origin = true;
  request.origin = "http://127.0.0.1:8586";
  EXPECT_EQ(site.ask(request).status, 204U);
  EXPECT_EQ(site.router.admit(request), Role::command);
}

TEST(Router, OnAnyAddressNumbersAreOurNames) {
  Site site{tokens, {.names = {"localhost", "pi"}, .any_address = true}};
  for (const auto& [host, status] : {std::pair{"10.0.0.1:8586", 200U}, {"[fe80::1]:8586", 200U}, {"pi:8586", 200U},
                                     {"evil.example:8586", 403U}, {"", 403U}}) {
    auto request = Site::request("GET", "/healthz");
    request.host = host;
    EXPECT_EQ(site.ask(request).status, status) << host;
  }
}

TEST(Router, AsksForASession) {
  Site site{tokens};
  for (const auto* path : {"/api/v1/status", "/api/v1/ports", "/api/v1/catalogue", "/api/v1/nothing", "/api/"})
    EXPECT_EQ(code(site.ask("GET", path)), "no_session") << path;
  EXPECT_EQ(site.router.admit(Site::request("GET", "/api/v1/stream")).error().status, 401U);
  EXPECT_EQ(site.ask_as(tokens.watch, "GET", "/api/v1/status").status, 200U);
}

TEST(Router, WatchersChangeNothing) {
  Site site{tokens};
  EXPECT_EQ(code(site.ask_as(tokens.watch, "PUT", "/api/v1/conversion", R"({"on":true})")), "watch_only");
  EXPECT_EQ(code(site.ask_as(tokens.watch, "POST", "/api/v1/vehicle-links", "{}")), "watch_only");
  EXPECT_EQ(code(site.ask_as(tokens.watch, "DELETE", "/api/v1/vehicle-links/1")), "watch_only");
  EXPECT_EQ(code(site.ask_as(tokens.watch, "DELETE", "/api/v1/latency-study")), "watch_only");
  EXPECT_THAT(site.actions.done, IsEmpty());
}

TEST(Router, GivesSessions) {
  Site site{tokens};
  const auto opened = site.ask("POST", "/api/v1/session", R"({"token":"watch-token-watch"})");
  EXPECT_EQ(opened.text(), R"({"role":"watch"})");
  EXPECT_EQ(header(opened, "Set-Cookie"), "ponte_session=1; HttpOnly; SameSite=Strict; Path=/");
  EXPECT_EQ(code(site.ask("POST", "/api/v1/session", R"({"token":"something else"})")), "wrong_token");
  for (const auto* body : {"", "{}", R"({"token":1})", R"({"token":"a","b":1})", R"(["token"])"})
    EXPECT_EQ(site.ask("POST", "/api/v1/session", body).status, 400U) << body;
  EXPECT_EQ(site.ask("DELETE", "/api/v1/session").status, 204U);
  EXPECT_EQ(site.ask("GET", "/api/v1/session").status, 405U);
  Router secure{site.access, site.files, site.actions, {.names = {"127.0.0.1"}}, true};
  const auto request = Site::request("POST", "/api/v1/session", R"({"token":"watch-token-watch"})");
  EXPECT_THAT(header(secure.handle(Timestamp{Duration{std::chrono::seconds{2}}}, request), "Set-Cookie"),
              HasSubstr("; Secure"));
}

TEST(Router, TheCatalogueIsSentOnce) {
  Site site;
  auto request = Site::request("GET", "/api/v1/catalogue");
  const auto first = site.ask(request);
  EXPECT_EQ(first.text(), R"({"mavlink":{}})");
  request.accepts_gzip = true;
  EXPECT_EQ(site.ask(request).text().substr(0, 2), "\x1f\x8b");
  request.if_none_match = header(first, "ETag");
  const auto again = site.ask(request);
  EXPECT_EQ(again.status, 304U);
  EXPECT_EQ(again.body, nullptr);
}

TEST(Router, DoesWhatCommandersAskFor) {
  Site site;
  EXPECT_EQ(site.ask("PUT", "/api/v1/conversion", R"({"on":false})").status, 204U);
  EXPECT_EQ(site.ask("POST", "/api/v1/vehicle-links", R"({"endpoint":"udpin://[::]:1"})").status, 201U);
  EXPECT_EQ(site.ask("DELETE", "/api/v1/vehicle-links/1").status, 204U);
  EXPECT_EQ(site.ask("DELETE", "/api/v1/vehicle-links/2").status, 404U);
  EXPECT_EQ(site.ask("POST", "/api/v1/latency-study", R"({"samples":30,"limit_ms":500})").status, 202U);
  EXPECT_EQ(code(site.ask("POST", "/api/v1/latency-study", R"({"samples":99,"limit_ms":500})")), "busy");
  EXPECT_EQ(site.ask("DELETE", "/api/v1/latency-study").status, 204U);
  EXPECT_THAT(site.actions.done,
              ElementsAre("do not convert", "connect udpin://[::]:1", "disconnect 1", "disconnect 2", "study 30 500",
                          "study 99 500", "stop"));
}

TEST(Router, RefusesWhatItDoesNotUnderstand) {
  Site site;
  for (const auto* body : {"", "{", "{}", R"({"on":1})", R"({"on":true,"off":false})", "[true]", "true"})
    EXPECT_EQ(site.ask("PUT", "/api/v1/conversion", body).status, 400U) << body;
  for (const auto* body :
       {R"({"samples":1,"limit_ms":5})", R"({"samples":10001,"limit_ms":5})", R"({"samples":2.5,"limit_ms":5})",
        R"({"samples":5,"limit_ms":0})", R"({"samples":5,"limit_ms":60001})", R"({"samples":5})",
        R"({"samples":"5","limit_ms":5})", R"({"samples":99999999999999999999,"limit_ms":5})"})
    EXPECT_EQ(site.ask("POST", "/api/v1/latency-study", body).status, 400U) << body;
  for (const auto* link : {"", "x", "-1", "1x", "99999999999", "1/2"})
    EXPECT_EQ(site.ask("DELETE", std::string{"/api/v1/vehicle-links/"} + link).status, 404U) << link;
  EXPECT_EQ(site.ask("GET", "/api/v1/vehicle-links").status, 404U);
  EXPECT_EQ(site.ask("GET", "/api/v1/stream").status, 426U);
  EXPECT_THAT(site.actions.done, IsEmpty());
}

TEST(Router, HandsOutTheStudy) {
  Site site;
  auto request = Site::request("GET", "/api/v1/latency-study/result");
  EXPECT_EQ(site.ask(request).status, 404U);
  site.actions.has_study = true;
  EXPECT_EQ(site.ask(request).text(), "json");
  request.query = "format=csv";
  EXPECT_EQ(header(site.ask(request), "Content-Disposition"), "attachment; filename=\"ponte-latency.csv\"");
  request.query = "format=exe";
  EXPECT_EQ(site.ask(request).status, 400U);
}

}  // namespace
}  // namespace ponte::app
