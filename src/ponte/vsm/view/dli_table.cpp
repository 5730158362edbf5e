#include "ponte/vsm/view/dli_table.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/core/hex.hpp"
#include "ponte/dli/json.hpp"
#include "ponte/dli/walk.hpp"

namespace ponte::vsm::view {

void SentMessage::assign(const OutgoingMessage& message) {
  time = message.time;
  bytes.assign(message.bytes().begin(), message.bytes().end());
  json.clear();
}

dli::WrapperView DliTable::read(Bytes bytes) const {
  const auto view = dli::parse_message(bytes, profile_);
  PONTE_ASSERT(view.has_value());
  return *view;
}

DliTable::Row& DliTable::add(Timestamp now, const OutgoingMessage& message) {
  const auto view = read(message.bytes());
  auto& row = rows_[{view.source, view.number}];
  row.rate.on_message(now);
  row.is_silent = false;
  row.last.assign(message);
  const auto* info = catalogue_->find(view.number);
  if (info == nullptr || !profile_.has_fields(*info)) return row;
  row.fields.resize(info->fields.size());
  const auto walked = dli::walk(*info, view.data, profile_, [&](const dli::FieldInfo& field, Bytes bytes) {
    row.fields[static_cast<std::size_t>(&field - info->fields.data())].assign(bytes.begin(), bytes.end());
  });
  PONTE_ASSERT(walked.has_value());
  return row;
}

const std::string& DliTable::json_of(SentMessage& message) const {
  if (!message.json.empty()) return message.json;
  const auto view = read(message.bytes);
  const auto* info = catalogue_->find(view.number);
  JsonText json;
  json.begin_object();
  dli::append_header(json, view, info, profile_, unix_ms(message.time));
  json.key("fields").begin_object();
  JsonText held;
  held.begin_object();
  if (const auto row = rows_.find({view.source, view.number}); row != rows_.end() && !row->second.fields.empty()) {
    dli::FieldReader reader{*info, view.data, profile_};
    for (std::size_t i = 0; i < info->fields.size(); ++i) {
      const auto& field = info->fields[i];
      const auto& newest = row->second.fields[i];
      const auto scale = profile_.scale_of(*info, field);
      if (const auto present = reader.next(field); present && !field.excluded)
        dli::append_field(json, field, *present, scale);
      else if (!newest.empty())
        dli::append_field(held, field, newest, scale);
    }
  }
  held.end_object();
  json.end_object().key("held").written(held.text());
  json.member("hex", std::string_view{to_hex(message.bytes)}).end_object();
  message.json = json.text();
  return message.json;
}

}  // namespace ponte::vsm::view
