#pragma once

#include "ponte/core/id.hpp"
#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/rate_limit.hpp"
#include "ponte/mavlink/recent_frames.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace ponte::mavlink {

/// One exchange with one peer, numbered by who runs the router. No number is used twice within `RecentFrames::window`.
using RouteLinkId = Id<struct RouteLinkIdTag, std::uint16_t>;

/// What is special about a link.
struct RouteRules {
  /// No risky message (`is_risky`) comes from there or goes there.
  bool untrusted{};
  struct Limit {
    MessageId message{};
    std::optional<Duration> pause{};  ///< between two that go there; nothing: none goes
  };
  std::vector<Limit> limits{};
};

/// Why a frame goes nowhere, or not to one link.
enum class RouteDrop : std::uint8_t {
  no_other_link,   ///< for everybody, but nobody else is there
  unknown_target,  ///< its target has not been heard on another link lately
  setup_signing,   ///< a key is never passed on
  untrusted,       ///< risky, and this link is untrusted: where it came from, or where it would go
  duplicate,       ///< the very same frame came on another link before: there are two ways, or a loop
  rate_limit,      ///< more of them than this link may be sent
};
inline constexpr std::size_t route_drop_count = 6;
/// "no other link", "unknown target", ...
[[nodiscard]] std::string_view name_of(RouteDrop reason);

/// What a link has seen since it was added. Nothing here ever goes down.
struct RouteCounters {
  std::uint64_t received{};  ///< frames that came from there
  std::uint64_t repeated{};  ///< of these, the very same as one shortly before: passed on, but many tell of a loop
  std::uint64_t sent{};      ///< frames that went there
  std::array<std::uint64_t, route_drop_count>
      dropped{};  ///< `untrusted` counts both ways, `rate_limit` what would go there
};

/// Decides where frames go, by the rules of MAVLink's routing guide: what is for everybody, or unknown, goes to all
/// other links; what is for one system, to the links where it was heard; nothing goes back to where it came from.
/// Frames are passed on byte for byte, signed ones too.
///
/// Knows no clock and no socket, and allocates nothing per frame.
class Router {
 public:
  static constexpr std::size_t link_limit = 64;
  /// A system that was silent on a link for so long is not there any more.
  static constexpr Duration address_lifetime = std::chrono::seconds{60};

  /// `seed`: see `RecentFrames`.
  explicit Router(std::uint64_t seed);
  ~Router();

  /// False if there are too many links. The link is a new one.
  [[nodiscard]] bool add_link(RouteLinkId link, RouteRules rules);
  void remove_link(RouteLinkId link);

  /// A frame with a right checksum, or of a message that is unknown; then `message` is nothing. Returns the links it
  /// has to be sent to, as it is; they are valid until the next call. The link has been added.
  [[nodiscard]] std::span<const RouteLinkId> on_frame(Timestamp now, RouteLinkId from, const FrameView& frame,
                                                      const MessageInfo* message);

  /// Nothing if there is no such link.
  [[nodiscard]] const RouteCounters* counters(RouteLinkId link) const;
  /// The systems that were heard there lately, ascending.
  [[nodiscard]] std::vector<SystemId> systems_on(Timestamp now, RouteLinkId link) const;

 private:
  struct Link;

  [[nodiscard]] Link* find(RouteLinkId link) const;
  [[nodiscard]] std::optional<RouteDrop> refusal_of(Timestamp now, Link& from, const FrameView& frame);
  [[nodiscard]] static bool admits(Timestamp now, Link& to, const FrameView& frame);

  std::vector<std::unique_ptr<Link>> links_;
  RecentFrames recent_;
  std::array<RouteLinkId, link_limit> targets_{};
};

}  // namespace ponte::mavlink
