#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/vsm/view/bridge_view.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ponte::app {

/// What the server looks at of a request. A header that is missing, or there more than once, is empty.
struct HttpRequest {
  std::string method{};  ///< in capitals
  std::string path{};    ///< up to the question mark, not decoded
  std::string query{};   ///< behind it
  std::string host{};
  std::string origin{};
  std::string cookie{};
  std::string if_none_match{};
  bool has_origin{};    ///< the header is there, whatever it says
  bool accepts_gzip{};
  std::string body{};
};

/// An answer. The body is shared, since many clients get the same.
struct HttpResponse {
  unsigned status = 200;
  std::string type = "application/json";
  vsm::view::SharedText body{};  ///< nothing: no body
  std::vector<std::pair<std::string, std::string>> headers{};

  [[nodiscard]] std::string_view text() const { return body ? std::string_view{*body} : std::string_view{}; }
};

[[nodiscard]] inline vsm::view::SharedText shared_text(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

/// The Problem of web/contract/openapi.yaml.
[[nodiscard]] inline HttpResponse problem(unsigned status, std::string_view code, std::string_view detail) {
  JsonText json;
  json.begin_object().member("code", code).member("detail", detail).end_object();
  return {.status = status, .body = shared_text(json.text())};
}

}  // namespace ponte::app
