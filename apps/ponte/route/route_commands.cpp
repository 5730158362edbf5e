#include "route/route_commands.hpp"

#include "common/failure.hpp"
#include "common/json_line.hpp"
#include "route/route_limit.hpp"
#include "route/route_side.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cstdio>
#include <sstream>

namespace ponte::app {
namespace {

constexpr auto grammar = "expected add ENDPOINT [untrusted] [MESSAGE:HZ]..., remove ENDPOINT|NUMBER, or list";

transport::Endpoint endpoint_in(const std::string& text) {
  const auto endpoint = transport::parse_endpoint(text);
  if (!endpoint) throw UsageError{fmt::format("{}: {}", text, transport::to_text(endpoint.error()))};
  return *endpoint;
}

}  // namespace

void RouteCommands::obey(std::string_view line) {
  std::istringstream text{std::string{line.substr(0, line.find('#'))}};
  Words words;
  for (std::string word; text >> word;) words.push_back(word);
  if (words.empty()) return;

  json_.begin_object().member("kind", "answer").member("command", line);
  std::string said;
  try {
    said = answer(words);
  } catch (const std::runtime_error& error) {
    json_.member("error", std::string_view{error.what()});
    said = fmt::format("error: {}", error.what());
  }
  json_.end_object();
  if (prints_json_)
    print_line(json_);
  else
    fmt::print("{}\n", said);
  json_.clear();
  std::fflush(stdout);
}

std::string RouteCommands::answer(const Words& words) {
  if (words[0] == "add" && words.size() >= 2) return add(words);
  if (words[0] == "remove" && words.size() == 2) return remove(words[1]);
  if (words[0] == "list" && words.size() == 1) return list();
  throw UsageError{fmt::format("{}: {}", fmt::join(words, " "), grammar)};
}

std::string RouteCommands::add(const Words& words) {
  const auto endpoint = endpoint_in(words[1]);
  mavlink::RouteRules rules;
  for (std::size_t i = 2; i < words.size(); ++i) {
    if (words[i] == "untrusted")
      rules.untrusted = true;
    else if (const auto limit = route_limit_from(words[i]))
      rules.limits.push_back(*limit);
    else
      throw UsageError{fmt::format("{}: expected untrusted, or MESSAGE:HZ as in ATTITUDE:4", words[i])};
  }
  const auto number = router_.add(endpoint, std::move(rules));
  const auto name = transport::to_text(endpoint);
  json_.member("number", number).member("endpoint", std::string_view{name});
  return fmt::format("added {} {}", number, name);
}

std::string RouteCommands::remove(const std::string& which) {
  const auto number = number_of(which);
  const auto name = router_.sides().at(number)->name();
  router_.remove(number);
  json_.member("number", number).member("endpoint", std::string_view{name});
  return fmt::format("removed {} {}", number, name);
}

std::string RouteCommands::list() {
  std::vector<std::string> all;
  json_.key("endpoints").begin_array();
  for (const auto& [number, side] : router_.sides()) {
    const auto state = transport::name_of(side->state());
    json_.begin_object().member("number", number).member("endpoint", std::string_view{side->name()});
    json_.member("state", state).member("links", std::uint64_t{side->peer_count()});
    json_.member("untrusted", side->is_untrusted()).end_object();
    all.push_back(fmt::format("{} {}{} {}, {} links", number, side->name(), side->is_untrusted() ? " untrusted" : "",
                              state, side->peer_count()));
  }
  json_.end_array();
  return all.empty() ? "no endpoints" : fmt::format("{}", fmt::join(all, "; "));
}

unsigned RouteCommands::number_of(const std::string& which) const {
  unsigned number{};
  const auto* const end = which.data() + which.size();
  if (const auto [rest, error] = std::from_chars(which.data(), end, number); error == std::errc{} && rest == end) {
    if (!router_.sides().contains(number)) throw UsageError{fmt::format("there is no endpoint {}", number)};
    return number;
  }
  const auto endpoint = endpoint_in(which);
  std::vector<unsigned> found;
  for (const auto& [candidate, side] : router_.sides())
    if (side->endpoint() == endpoint) found.push_back(candidate);
  if (found.empty()) throw UsageError{fmt::format("{} is not routed", which)};
  if (found.size() > 1)
    throw UsageError{fmt::format("{} is routed more than once; its numbers are {}", which, fmt::join(found, ", "))};
  return found.front();
}

}  // namespace ponte::app
