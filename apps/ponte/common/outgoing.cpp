#include "common/outgoing.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/dli/datagram.hpp"
#include "ponte/dli/json.hpp"
#include "ponte/dli/messages/catalogue.hpp"

namespace ponte::app {

dli::WrapperView view_of(const vsm::OutgoingMessage& message, const dli::Profile& profile) {
  dli::DatagramCounters counters;
  dli::DatagramReader reader{message.bytes(), profile, counters};
  const auto view = reader.next();
  PONTE_ASSERT(view && *view);
  return **view;
}

void append_json(JsonText& json, const vsm::OutgoingMessage& message, const dli::Profile& profile) {
  const auto written =
      dli::append_json(json, view_of(message, profile), dli::messages::catalogue, profile, unix_ms(message.time));
  PONTE_ASSERT(written.has_value());
}

}  // namespace ponte::app
