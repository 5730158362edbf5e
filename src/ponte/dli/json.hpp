#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/core/result.hpp"
#include "ponte/dli/message_info.hpp"
#include "ponte/dli/presence.hpp"
#include "ponte/dli/profile.hpp"
#include "ponte/dli/wrapper.hpp"

#include <cstdint>

namespace ponte::dli {

/// Appends one message as a JSON object:
/// `{"time_ms":...,"number":4000,"name":"Inertial States","edition":"3","source":"14:60:00:02",
/// "destination":"14:20:00:02","fields":{"roll":{"raw":1820,"value":0.17449,"unit":"rad"},...}}`.
///
/// `time_ms` is when the message was sent or received, in ms since 1970 UTC. Only present fields appear. `value` is
/// there where the scale is known; `unit` goes with it, and with floats, whose raw value is physical. An enumeration
/// has its name as `label`, a bitmap the list of the names of its set bits, an id its text with colons; a value without
/// a name has no label. When the peer announced fields that the edition does not know, the object has
/// `"newer_fields":true`. A message without field table in the profile's edition has `"partial":true` and its data as
/// hex in `data`; one that is not in the catalogue is named "unknown". After an error nothing has been written.
[[nodiscard]] Result<DecodeFacts, DecodeError> append_json(JsonText& json, const WrapperView& message,
                                                           const Catalogue& catalogue, const Profile& profile,
                                                           std::int64_t time_ms);

/// Appends the members of `append_json` that stand before the fields, to an object that has begun. `info` is nothing
/// for a message that is not in the catalogue.
void append_header(JsonText& json, const WrapperView& message, const MessageInfo* info, const Profile& profile,
                   std::int64_t time_ms);

/// Appends one field as a member of an object that has begun: its key, and `raw`, `value`, `unit` and `label` as in
/// `append_json`. `bytes` is what a message has of it, `scale` that of the profile.
void append_field(JsonText& json, const FieldInfo& field, Bytes bytes, double scale);

}  // namespace ponte::dli
