#include "ponte/autopilot/flight_watch.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/extended_sys_state.hpp"
#include "ponte/mavlink/autopilots/global_position_int.hpp"
#include "ponte/mavlink/autopilots/heartbeat.hpp"
#include "ponte/mavlink/codec.hpp"

namespace ponte::autopilot {

namespace messages = mavlink::autopilots;

bool FlightWatch::on_message(Timestamp now, const mavlink::FrameView& frame) {
  if (frame.system != peer_.system || frame.component != peer_.component) return false;
  if (mavlink::carries<messages::Heartbeat>(frame)) {
    const auto heartbeat = mavlink::decode<messages::Heartbeat>(frame);
    if ((heartbeat.base_mode & messages::MAV_MODE_FLAG_CUSTOM_MODE_ENABLED) == 0) return false;
    heartbeat_at_ = now;
    custom_mode_ = heartbeat.custom_mode;
    armed_ = (heartbeat.base_mode & messages::MAV_MODE_FLAG_SAFETY_ARMED) != 0;
    return true;
  }
  if (mavlink::carries<messages::ExtendedSysState>(frame)) {
    landed_state_at_ = now;
    landed_state_ = mavlink::decode<messages::ExtendedSysState>(frame).landed_state;
    return true;
  }
  if (mavlink::carries<messages::GlobalPositionInt>(frame)) {
    const auto position = mavlink::decode<messages::GlobalPositionInt>(frame);
    if (position.lat == 0 && position.lon == 0) return false;  // as long as there is none
    place_ = Place{.latitude = radians_from_degrees(position.lat * 1e-7),
                   .longitude = radians_from_degrees(position.lon * 1e-7),
                   .altitude_msl = Metres{position.alt * 1e-3},
                   .height = Metres{position.relative_alt * 1e-3}};
    place_at_ = now;
    if (heartbeat_at_ && !armed_) ground_ = place_->height;
    return true;
  }
  return false;
}

bool FlightWatch::has_mode(std::uint32_t custom_mode, Timestamp since) const {
  return heartbeat_at_ && *heartbeat_at_ > since && custom_mode_ == custom_mode;
}

bool FlightWatch::has_other_mode(std::uint32_t custom_mode, Timestamp since) const {
  return heartbeat_at_ && *heartbeat_at_ > since && custom_mode_ != custom_mode;
}

bool FlightWatch::is_armed(bool armed, Timestamp since) const {
  return heartbeat_at_ && *heartbeat_at_ > since && armed_ == armed;
}

bool FlightWatch::is_in_the_air(Timestamp since) const {
  if (!is_armed(true, since)) return false;
  if (landed_state_at_ && *landed_state_at_ > since) {
    if (landed_state_ == messages::MAV_LANDED_STATE_IN_AIR) return true;
    if (landed_state_ == messages::MAV_LANDED_STATE_ON_GROUND) return false;
  }
  return place_ && place_at_ > since && place_->height - ground_ >= off_the_ground;
}

}  // namespace ponte::autopilot
