#pragma once

#include "web/http_message.hpp"

#include <boost/beast/http.hpp>

#include <string>
#include <string_view>

/// From Beast's messages to ours. For those sources alone that include Beast anyway.
namespace ponte::app {

using BeastRequest = boost::beast::http::request<boost::beast::http::string_body>;

/// The value of a header that is there once; empty otherwise, since a second one may be a trick.
[[nodiscard]] inline std::string only_header(const BeastRequest& message, boost::beast::http::field name) {
  const auto [first, last] = message.equal_range(name);
  if (first == last || std::next(first) != last) return {};
  return std::string{first->value()};
}

[[nodiscard]] inline HttpRequest request_from(const BeastRequest& message) {
  using boost::beast::http::field;
  const std::string target{message.target()};
  const auto question = target.find('?');
  HttpRequest request;
  request.method = std::string{message.method_string()};
  request.path = target.substr(0, question);
  if (question != std::string::npos) request.query = target.substr(question + 1);
  request.host = only_header(message, field::host);
  request.origin = only_header(message, field::origin);
  request.has_origin = message.count(field::origin) > 0;
  request.cookie = only_header(message, field::cookie);
  request.if_none_match = only_header(message, field::if_none_match);
  for (const auto& coding : boost::beast::http::ext_list{message[field::accept_encoding]})
    request.accepts_gzip |= coding.first == "gzip";
  request.body = message.body();
  return request;
}

}  // namespace ponte::app
