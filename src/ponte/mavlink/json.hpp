#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/core/time.hpp"
#include "ponte/mavlink/frame.hpp"
#include "ponte/mavlink/message_info.hpp"

/// MAVLink as JSON lines.
namespace ponte::mavlink {

/// Appends one frame as an object: `{"time_us":..., "id":30, "name":"ATTITUDE", "version":2, "system":1, "component":1,
/// "sequence":7, "fields":{"roll":0.1, ...}}`. Arrays become lists, arrays of characters texts. Every field of the
/// message is there, with zeros for what was not sent. Values that have names are told by `append_labels` too. Without
/// a `message` the name is `unknown:ID`, and the payload follows as it was sent, in hex, instead of the fields.
void append_frame(JsonText& json, WallTime time, const FrameView& frame, const MessageInfo* message);

/// Appends the members of `append_frame` that stand before the fields, to an object that has begun.
void append_header(JsonText& json, WallTime time, const FrameView& frame, const MessageInfo* message);

/// Appends the fields of a payload as an object: the `fields` of `append_frame`.
void append_fields(JsonText& json, const MessageInfo& message, Bytes payload);

/// Appends the member `"labels":{"type":"MAV_TYPE_QUADROTOR", ...}` to an object that has begun: what enumerations call
/// the values of the fields, as `words_of` writes it; a list for an array. Fields without a named value are not there,
/// and if none has one, neither is the member.
void append_labels(JsonText& json, const MessageInfo& message, Bytes payload);

}  // namespace ponte::mavlink
