#include "ponte/vsm/view/mavlink_table.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/core/hex.hpp"
#include "ponte/mavlink/field_value.hpp"
#include "ponte/mavlink/json.hpp"

#include <algorithm>
#include <limits>
#include <variant>

namespace ponte::vsm::view {
namespace {

/// The field that tells several of the message apart, where it is one integer of at most 32 bits; otherwise nothing.
const mavlink::FieldInfo* instance_field(const mavlink::MessageInfo* message) {
  if (message == nullptr) return nullptr;
  const auto found = std::ranges::find_if(message->fields, [](const mavlink::FieldInfo& field) {
    return field.instance && field.array_length == 0 && size_of(field.type) <= 4 &&
           field.type != mavlink::FieldType::float32;
  });
  return found == message->fields.end() ? nullptr : &*found;
}

std::int64_t instance_of(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) {
  const auto* field = instance_field(message);
  if (field == nullptr) return 0;
  return std::visit([](auto value) { return static_cast<std::int64_t>(value); },
                    mavlink::read_element(*field, readable_payload(frame, *message)));
}

}  // namespace

void StoredCrossing::assign(std::uint64_t its_number, const Crossing& crossing) {
  number = its_number;
  time = crossing.time;
  decoded = crossing.decoded - crossing.received;
  translated = crossing.translated - crossing.received;
  sent = crossing.sent - crossing.received;
  frame.assign(crossing.frame.whole.begin(), crossing.frame.whole.end());
  messages.resize(crossing.messages.size());
  for (std::size_t i = 0; i < messages.size(); ++i) messages[i].assign(crossing.messages[i]);
  frame_json.clear();
}

MavlinkRow* MavlinkTable::add(std::uint64_t number, const Crossing& crossing) {
  const auto& frame = crossing.frame;
  if (links_.size() < link_limit || links_.contains(crossing.link_id))
    links_[crossing.link_id].senders.on_frame(frame.system, frame.component, frame.sequence);
  const MavlinkKey key{crossing.link_id, frame.system, frame.component, frame.message,
                       instance_of(frame, crossing.message)};
  auto found = rows_.find(key);
  if (found == rows_.end()) {
    if (rows_.size() == row_limit) return nullptr;
    found = rows_.try_emplace(key).first;
  }
  auto& row = found->second;
  row.message = crossing.message;
  row.is_silent = false;
  row.rate.on_message(crossing.received);
  (crossing.messages.empty() ? row.plain : row.translated).assign(number, crossing);
  return &row;
}

void MavlinkTable::remove(VehicleLinkId link) {
  std::erase_if(rows_, [&](const auto& entry) { return entry.first.link == link; });
  links_.erase(link);
}

const std::string& MavlinkTable::json_of(const MavlinkKey& key, const MavlinkRow& row, StoredCrossing& crossing) {
  if (!crossing.frame_json.empty()) return crossing.frame_json;
  const auto frame = mavlink::parse_frame(crossing.frame);
  PONTE_ASSERT(frame.has_value());
  JsonText json;
  json.begin_object().member("link", key.link.value);
  mavlink::append_header(json, crossing.time, *frame, row.message);
  if (const auto* field = instance_field(row.message); field != nullptr)
    json.key("instance").begin_object().member("field", field->name).member("value", key.instance).end_object();
  if (row.message != nullptr) {
    json.key("fields");
    mavlink::append_fields(json, *row.message, readable_payload(*frame, *row.message));
  }
  json.member("hex", std::string_view{to_hex(crossing.frame)}).end_object();
  crossing.frame_json = json.text();
  return crossing.frame_json;
}

}  // namespace ponte::vsm::view
