#include "ponte/autopilot/dialect.hpp"

#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/v09/dialect.hpp"

namespace ponte::autopilot {

const mavlink::Dialect dialect{mavlink::autopilots::dialect.name, mavlink::autopilots::dialect.messages,
                               &mavlink::v09::dialect};

}  // namespace ponte::autopilot
