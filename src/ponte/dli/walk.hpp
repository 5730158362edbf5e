#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"
#include "ponte/dli/message_info.hpp"
#include "ponte/dli/presence.hpp"
#include "ponte/dli/profile.hpp"

namespace ponte::dli {

/// Calls `visitor(const FieldInfo&, Bytes)` for each present field of any message, without its generated struct. Fields
/// out of scope are stepped over. When an error is returned, the fields before it have been visited.
template <class Visitor>
[[nodiscard]] Result<DecodeFacts, DecodeError> walk(const MessageInfo& message, Bytes data, const Profile& profile,
                                                    Visitor&& visitor) {
  FieldReader reader{message, data, profile};
  for (const auto& field : message.fields)
    if (const auto bytes = reader.next(field); bytes && !field.excluded) visitor(field, *bytes);
  return reader.finish();
}

}  // namespace ponte::dli
