#include "route/route_limit.hpp"

#include "ponte/mavlink/autopilots/dialect.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>

namespace ponte::app {

std::optional<mavlink::RouteRules::Limit> route_limit_from(std::string_view text) {
  const auto colon = text.rfind(':');
  if (colon == std::string_view::npos) return {};
  const auto& messages = mavlink::autopilots::dialect.messages;
  const auto message = std::ranges::find(messages, text.substr(0, colon), &mavlink::MessageInfo::name);
  if (message == messages.end()) return {};
  double hz{};
  const auto* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, hz);
  if (error != std::errc{} || rest != end || !(hz == 0 || (hz >= 0.001 && hz <= 1e6))) return {};
  mavlink::RouteRules::Limit limit{.message = (*message)->id};
  if (hz > 0) limit.pause = std::chrono::duration_cast<Duration>(std::chrono::duration<double>{1 / hz});
  return limit;
}

}  // namespace ponte::app
