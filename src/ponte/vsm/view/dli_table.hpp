#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/dli/entity_id.hpp"
#include "ponte/dli/message_info.hpp"
#include "ponte/dli/profile.hpp"
#include "ponte/dli/wrapper.hpp"
#include "ponte/vsm/telemetry.hpp"
#include "ponte/vsm/view/rate_meter.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ponte::vsm::view {

/// A copy of a DLI message that was sent, and its JSON once somebody has asked for it.
struct SentMessage {
  WallTime time{};
  std::vector<std::byte> bytes{};
  std::string json{};

  void assign(const OutgoingMessage& message);
};

/// The newest message of every (source, number), and the newest value of each of its fields. Bounded by the vehicles
/// and messages that the VSM speaks of.
class DliTable {
 public:
  using Key = std::pair<dli::EntityId, dli::MessageNumber>;
  struct Row {
    RateMeter rate{};
    std::uint64_t revision{};  ///< grows with each change of any row
    bool is_silent{};          ///< its revision has grown because nothing came any more
    std::uint64_t clock_number{};  ///< of the event, when the newest message was sent by the clock; otherwise 0
    SentMessage last{};
    std::vector<std::vector<std::byte>> fields{};  ///< what was told last, by the field's place in the table
  };

  /// The catalogue outlives the table.
  DliTable(const dli::Catalogue& catalogue, dli::Profile profile)
      : catalogue_{&catalogue}, profile_{std::move(profile)} {}

  /// A message that the VSM has sent. Returns its row.
  Row& add(Timestamp now, const OutgoingMessage& message);
  [[nodiscard]] std::map<Key, Row>& rows() { return rows_; }

  /// The object DliMessage of web/contract/messages.schema.json.
  [[nodiscard]] const std::string& json_of(SentMessage& message) const;

 private:
  /// The only message of what we have sent.
  [[nodiscard]] dli::WrapperView read(Bytes bytes) const;

  const dli::Catalogue* catalogue_;
  dli::Profile profile_;
  std::map<Key, Row> rows_;
};

}  // namespace ponte::vsm::view
