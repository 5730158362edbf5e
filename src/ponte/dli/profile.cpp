#include "ponte/dli/profile.hpp"

#include "ponte/core/assert.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ponte::dli {

void Profile::override_scale(MessageNumber message, std::uint8_t field, double scale) {
  PONTE_ASSERT(std::isfinite(scale) && scale > 0);
  const auto place = std::ranges::lower_bound(scale_overrides_, std::pair{message, field}, {}, [](const auto& entry) {
    return std::pair{entry.message, entry.field};
  });
  if (place != scale_overrides_.end() && place->message == message && place->field == field)
    place->scale = scale;
  else
    scale_overrides_.insert(place, {message, field, scale});
}

void Profile::override_presence_bytes(MessageNumber message, std::uint8_t bytes) {
  PONTE_ASSERT(bytes >= 1 && bytes <= 8);
  const auto place = std::ranges::lower_bound(presence_overrides_, message, {}, &PresenceOverride::message);
  if (place != presence_overrides_.end() && place->message == message)
    place->bytes = bytes;
  else
    presence_overrides_.insert(place, {message, bytes});
}

double Profile::scale_of(const MessageInfo& message, const FieldInfo& field) const {
  if (field.type == FieldType::bam) return bam_scale(field.width);
  if (scale_overrides_.empty()) return field.scale;
  const auto place =
      std::ranges::lower_bound(scale_overrides_, std::pair{message.number, field.number}, {}, [](const auto& entry) {
        return std::pair{entry.message, entry.field};
      });
  const auto overridden =
      place != scale_overrides_.end() && place->message == message.number && place->field == field.number;
  return overridden ? place->scale : field.scale;
}

std::uint8_t Profile::overridden_presence_bytes(const MessageInfo& message) const {
  const auto place = std::ranges::lower_bound(presence_overrides_, message.number, {}, &PresenceOverride::message);
  const auto overridden = place != presence_overrides_.end() && place->message == message.number;
  return overridden ? place->bytes : message.presence_bytes_in(edition);
}

}  // namespace ponte::dli
