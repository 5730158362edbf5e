#pragma once

#include "common/log.hpp"
#include "ponte/mavlink/router.hpp"
#include "ponte/transport/endpoint.hpp"
#include "ponte/transport/link.hpp"
#include "ponte/transport/loop.hpp"

#include <map>
#include <memory>
#include <optional>

namespace ponte::app {

class RouteSide;

/// A router on real links. Each peer of an endpoint is a link of its own, but for those of a multicast group, who all
/// hear what is said there. No peer keeps another waiting: what a slow one does not take is dropped by its own queue.
class LiveRouter {
 public:
  LiveRouter(transport::Loop& loop, Log log);
  ~LiveRouter();

  /// Opens an endpoint and returns its number; they count from 1, and none is used twice. Throws `Failure`.
  unsigned add(const transport::Endpoint& endpoint, mavlink::RouteRules rules);
  /// Closes an endpoint, of which there is one of that number.
  void remove(unsigned number);
  /// The endpoints by their numbers.
  [[nodiscard]] const std::map<unsigned, std::unique_ptr<RouteSide>>& sides() const { return sides_; }

  /// Frames in, frames out, and frames that were dropped, of all peers that are there.
  struct Totals {
    std::size_t links{};
    std::uint64_t received{};
    std::uint64_t sent{};
    std::uint64_t dropped{};
  };
  [[nodiscard]] Totals totals() const;
  /// Prints one JSON object per peer and per endpoint on stdout.
  void print_json() const;
  /// Says of each endpoint what it carried and lost.
  void log_counters() const;

 private:
  friend class RouteSide;
  struct Place {
    RouteSide* side{};
    transport::PeerId peer{};
  };

  /// The number of a new link; nothing if there are too many.
  [[nodiscard]] std::optional<mavlink::RouteLinkId> open_link(Place place, const mavlink::RouteRules& rules);
  void close_link(mavlink::RouteLinkId link);
  void pass_on(Timestamp now, mavlink::RouteLinkId from, const mavlink::FrameView& frame,
               const mavlink::MessageInfo* message);

  transport::Loop& loop_;
  Log log_;
  mavlink::Router router_;
  std::map<mavlink::RouteLinkId, Place> places_;
  std::uint16_t last_number_{};
  unsigned last_side_{};
  std::map<unsigned, std::unique_ptr<RouteSide>> sides_;
};

}  // namespace ponte::app
