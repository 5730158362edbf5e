#include "ponte/autopilot/dialect.hpp"

#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/v09/dialect.hpp"

namespace ponte::autopilot {

const mavlink::Dialect dialect{.name = mavlink::autopilots::dialect.name,
                               .messages = mavlink::autopilots::dialect.messages,
                               .v09 = &mavlink::v09::dialect,
                               .low = mavlink::autopilots::dialect.low};

}  // namespace ponte::autopilot
