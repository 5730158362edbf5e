// Requests as Beast reads them from bytes, and what the bridge page's server answers: it is always an answer, and nobody
// without a session changes anything.

#include "web/beast_request.hpp"
#include "web/test_site.hpp"

#include <boost/asio/buffer.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

using namespace ponte::app;
namespace http = boost::beast::http;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  http::request_parser<http::string_body> parser;
  parser.header_limit(8192);
  parser.body_limit(4096);
  parser.eager(true);
  boost::beast::error_code error;
  for (std::size_t at = 0; at < size && !error && !parser.is_done();) {
    const auto used = parser.put(boost::asio::buffer(data + at, size - at), error);
    if (used == 0) break;
    at += used;
  }
  if (error || !parser.is_done()) return 0;

  const Tokens tokens{.watch = "watch-token-watch", .command = "command-token-command"};
  Access access{tokens, [] { return std::string{"0123456789abcdef"}; }};
  const StaticFiles files;
  ponte::app::testing::RecordedActions actions;
  Router router{access, files, actions, {.names = {"localhost"}}, false};
  router.set_catalogue("{}");
  const auto request = request_from(parser.get());
  const auto response = router.handle({}, request);
  PONTE_ASSERT(response.status >= 200 && response.status < 600);
  PONTE_ASSERT(actions.done.empty());
  if (const auto admitted = router.admit(request); !admitted) PONTE_ASSERT(admitted.error().status >= 400);

  // The same as somebody who may command.
  auto commanding = request;
  commanding.host = "localhost";
  commanding.has_origin = false;
  commanding.cookie = "ponte_session=" + access.open(ponte::Timestamp{} + std::chrono::hours{1}, tokens.command)->id;
  PONTE_ASSERT(router.handle({}, commanding).status < 500);
  return 0;
}
