#include "vehicle/words.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/field_value.hpp"

namespace ponte::app {

using namespace autopilot;

namespace {

constexpr std::string_view not_sent = "too much is under way, or the vehicle speaks MAVLink 0.9, which has no commands";

}  // namespace

std::string_view to_text(CommandError error) {
  switch (error) {
    case CommandError::too_many: return "too many commands are under way";
    case CommandError::version_0_9: return "the vehicle speaks MAVLink 0.9, which has no such commands";
    case CommandError::no_such_place: return "expected a latitude of at most 90 and a longitude of at most 180 degrees";
  }
  return "";
}

std::string_view to_text(ModeError error) {
  switch (error) {
    case ModeError::not_heard: return "the vehicle has not told its mode yet";
    case ModeError::no_such_mode: return "this autopilot has no such mode";
    case ModeError::unknown_stack: return "it is not known how this autopilot begins a flight";
    case ModeError::in_the_air: return "the vehicle is in the air already";
    case ModeError::needs_height: return "expected a height: this autopilot has none of its own to take off to";
    case ModeError::has_own_height: return "expected no height: a plane takes off to its own (TKOFF_ALT)";
    case ModeError::height_invalid: return "expected a height above the ground, in metres";
    case ModeError::home_unknown: return "the vehicle does not tell the altitude of its home, which it has to be told";
    case ModeError::not_sent: return not_sent;
  }
  return "";
}

std::string_view to_text(GuidedError error) {
  switch (error) {
    case GuidedError::not_supported: return "this autopilot has no command for it";
    case GuidedError::invalid: return "expected numbers within their range";
    case GuidedError::home_unknown:
      return "the vehicle does not tell the altitude of its home, which it has to be told";
    case GuidedError::position_unknown: return "the vehicle does not tell where it is";
    case GuidedError::not_sent: return not_sent;
  }
  return "";
}

std::string_view to_text(StreamError error) {
  switch (error) {
    case StreamError::not_supported: return "this vehicle cannot be steered by velocities";
    case StreamError::invalid: return "expected numbers";
    case StreamError::on_the_ground: return "the vehicle is not known to be in the air";
    case StreamError::not_sent: return not_sent;
  }
  return "";
}

std::string_view to_text(GimbalError error) {
  switch (error) {
    case GimbalError::not_found: return "no gimbal was found";
    case GimbalError::not_in_control: return "somebody else controls the gimbal";
    case GimbalError::not_supported: return "an old mount knows angles from the nose only";
    case GimbalError::invalid: return "expected numbers within their range";
    case GimbalError::not_sent: return not_sent;
  }
  return "";
}

std::string_view to_text(CameraError error) {
  switch (error) {
    case CameraError::invalid: return "expected an interval above 0 seconds";
    case CameraError::not_sent: return not_sent;
  }
  return "";
}

std::string result_name(std::uint8_t mav_result) {
  return mavlink::words_of(mavlink::autopilots::enum_info::MAV_RESULT, mav_result);
}

std::string_view to_text(CommandFact::Kind kind) {
  switch (kind) {
    case CommandFact::Kind::progress: return "under way";
    case CommandFact::Kind::accepted: return "accepted";
    case CommandFact::Kind::refused: return "the vehicle refuses";
    case CommandFact::Kind::cancelled: return "cancelled";
    case CommandFact::Kind::no_answer: return "the vehicle does not answer; whether it is done is not known";
    case CommandFact::Kind::rebooted: return "the vehicle has started anew";
  }
  return "";
}

std::string_view to_text(ModeFact::Kind kind) {
  switch (kind) {
    case ModeFact::Kind::done: return "done";
    case ModeFact::Kind::refused: return "the vehicle refuses";
    case ModeFact::Kind::no_answer: return "the vehicle does not answer, and nothing is seen of it";
    case ModeFact::Kind::no_effect: return "the vehicle accepts it, but nothing comes of it";
    case ModeFact::Kind::superseded: return "something newer was wished";
    case ModeFact::Kind::rebooted: return "the vehicle has started anew";
  }
  return "";
}

std::string_view to_text(StreamFact::Kind kind) {
  switch (kind) {
    case StreamFact::Kind::steers: return "under way";
    case StreamFact::Kind::held: return "held";
    case StreamFact::Kind::mode_left: return "the vehicle has gone to another mode";
    case StreamFact::Kind::refused: return "the vehicle refuses its mode for it";
    case StreamFact::Kind::rebooted: return "the vehicle has started anew";
  }
  return "";
}

std::string_view to_text(ModeStep step) {
  switch (step) {
    case ModeStep::set_mode: return "the change of mode";
    case ModeStep::arm: return "arming";
    case ModeStep::disarm: return "disarming";
    case ModeStep::take_off: return "the take-off";
    case ModeStep::start_mission: return "the start of the mission";
  }
  return "";
}

}  // namespace ponte::app
