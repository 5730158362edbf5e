// What a client of the bridge page says over its WebSocket: it is understood as one thing, or refused with a reason.

#include "ponte/core/assert.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/vsm/view/client_feed.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

using namespace ponte;
using namespace ponte::vsm::view;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text{reinterpret_cast<const char*>(data), size};
  const auto request = parse_watch_request(text);
  if (!request) PONTE_ASSERT(!request.error().empty());

  // Takes long to make, and a client changes nothing in it.
  static BridgeView view{dli::messages::catalogue, {}};
  ClientFeed feed{view, Role::watch, false, "1"};
  PONTE_ASSERT(feed.on_message({}, text));
  bool is_refused = false;
  while (const auto message = feed.take({})) is_refused |= message->starts_with(R"({"kind":"refusal")");
  PONTE_ASSERT(is_refused == !request.has_value());
  return 0;
}
