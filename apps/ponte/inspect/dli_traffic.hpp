#pragma once

#include "inspect/tally.hpp"
#include "ponte/dli/datagram.hpp"
#include "ponte/dli/profile.hpp"

#include <map>
#include <vector>

namespace ponte::app {

/// Adds up the DLI messages that are heard, by source and number, and what is no good message.
class DliTraffic {
 public:
  explicit DliTraffic(const dli::Profile& profile) : profile_{profile} {}

  struct Key {
    dli::EntityId source;
    dli::MessageNumber number{};
    friend auto operator<=>(const Key&, const Key&) = default;
  };
  /// Calls `visit(message)` for each good message of the datagram.
  template <class Visitor>
  void on_datagram(WallTime time, Bytes datagram, Visitor&& visit) {
    dli::DatagramReader reader{datagram, profile_, counters};
    while (const auto message = reader.next()) {
      if (!*message) continue;
      messages[{(*message)->source, (*message)->number}].add(time, (*message)->whole);
      visit(**message);
    }
  }

  [[nodiscard]] const dli::Profile& profile() const { return profile_; }

  std::map<Key, Tally> messages;
  dli::DatagramCounters counters;

 private:
  dli::Profile profile_;
};

/// What a bad DLI message is called: "bad checksum", ...
[[nodiscard]] std::string_view name_of(dli::WrapperError error);

}  // namespace ponte::app
