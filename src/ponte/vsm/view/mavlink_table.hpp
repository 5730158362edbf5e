#pragma once

#include "ponte/mavlink/link_statistics.hpp"
#include "ponte/vsm/crossing.hpp"
#include "ponte/vsm/view/dli_table.hpp"
#include "ponte/vsm/view/rate_meter.hpp"

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ponte::vsm::view {

/// A copy of a crossing, and the JSON of its frame once somebody has asked for it.
struct StoredCrossing {
  std::uint64_t number{};  ///< of the event; 0: there was none
  WallTime time{};
  Duration decoded{};     ///< since it was received, like the others
  Duration translated{};
  Duration sent{};
  std::vector<std::byte> frame{};
  std::vector<SentMessage> messages{};
  std::string frame_json{};

  void assign(std::uint64_t its_number, const Crossing& crossing);
};

/// What tells messages apart. A message without instance field has the instance 0.
struct MavlinkKey {
  VehicleLinkId link{};
  mavlink::SystemId system{};
  mavlink::ComponentId component{};
  mavlink::MessageId message{};
  std::int64_t instance{};

  friend auto operator<=>(const MavlinkKey&, const MavlinkKey&) = default;
};

struct MavlinkRow {
  const mavlink::MessageInfo* message{};  ///< nothing: not in the dialect
  RateMeter rate{};
  std::uint64_t revision{};      ///< grows with each change of any row
  bool is_silent{};              ///< its revision has grown because nothing came any more
  StoredCrossing translated{};   ///< the newest that became DLI messages
  StoredCrossing plain{};        ///< the newest that did not

  [[nodiscard]] StoredCrossing& last() { return translated.number > plain.number ? translated : plain; }
};

/// The newest frame of every (link, system, component, message, instance), and what the sequence numbers of the senders
/// tell. Invented ids make nothing grow beyond the limits.
class MavlinkTable {
 public:
  static constexpr std::size_t row_limit = 4096;
  static constexpr std::size_t link_limit = 64;

  struct Link {
    mavlink::LinkStatistics senders{};
    std::uint64_t revision{};
  };

  /// The row of this frame, which it is entered in; nothing when the table is full.
  MavlinkRow* add(std::uint64_t number, const Crossing& crossing);
  /// Forgets what came from there.
  void remove(VehicleLinkId link);

  [[nodiscard]] std::map<MavlinkKey, MavlinkRow>& rows() { return rows_; }
  [[nodiscard]] std::map<VehicleLinkId, Link>& links() { return links_; }

  /// The object MavlinkMessage of web/contract/messages.schema.json.
  [[nodiscard]] static const std::string& json_of(const MavlinkKey& key, const MavlinkRow& row,
                                                  StoredCrossing& crossing);

 private:
  std::map<MavlinkKey, MavlinkRow> rows_;
  std::map<VehicleLinkId, Link> links_;
};

}  // namespace ponte::vsm::view
