#pragma once

#include "ponte/core/json_text.hpp"
#include "route/live_router.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace ponte::app {

/// The lines that a running router obeys, much as MAVProxy's `output add`, `remove` and `list`:
///
///     add ENDPOINT [untrusted] [MESSAGE:HZ]...
///     remove ENDPOINT|NUMBER
///     list
///
/// Each is answered by one line on stdout: "added NUMBER ENDPOINT", "removed NUMBER ENDPOINT", the endpoints, or
/// "error: REASON"; with `json` by an object with `"kind":"answer"`. Empty lines and those after # are passed over.
///
/// They are lines of stdin rather than a configuration file that is read again, so that a script learns from the answer
/// whether its own change was made, and nobody has to write down what else runs.
class RouteCommands {
 public:
  /// The router outlives us.
  RouteCommands(LiveRouter& router, bool json) : router_{router}, prints_json_{json} {}

  void obey(std::string_view line);

 private:
  using Words = std::vector<std::string>;

  /// Each writes members of the answer into `json_`, and returns it as text. Throws `UsageError` or `Failure`.
  std::string answer(const Words& words);
  std::string add(const Words& words);
  std::string remove(const std::string& which);
  std::string list();
  /// The number of an endpoint, which is written as its number or as the endpoint itself.
  [[nodiscard]] unsigned number_of(const std::string& which) const;

  LiveRouter& router_;
  bool prints_json_;
  JsonText json_;
};

}  // namespace ponte::app
