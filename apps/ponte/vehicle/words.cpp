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
    case GimbalError::home_unknown:
      return "the vehicle does not tell the altitude of its home, which it has to be told";
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

std::string_view to_text(MissionRefusal refusal) {
  switch (refusal) {
    case MissionRefusal::busy: return "another transfer is under way";
    case MissionRefusal::too_many_items: return "there are more items than could be read back";
    case MissionRefusal::needs_mavlink_2: return "MAVLink 1 has neither fences nor rally points";
    case MissionRefusal::not_in_mavlink_09: return "the vehicle speaks MAVLink 0.9, whose missions are other ones";
  }
  return "";
}

std::string_view to_text(MissionFailure failure) {
  switch (failure) {
    case MissionFailure::none: return "";
    case MissionFailure::refused: return "the vehicle refuses";
    case MissionFailure::occupied: return "somebody else transfers a plan, or it is being flown";
    case MissionFailure::silent: return "the vehicle does not answer";
    case MissionFailure::differs: return "what is on board is not what was sent";
    case MissionFailure::too_many: return "there are more items on board than can be read";
    case MissionFailure::unverified: return "the vehicle has taken it, but does not give it back";
  }
  return "";
}

std::string_view to_text(PlanOnBoard plan) {
  switch (plan) {
    case PlanOnBoard::as_requested: return "";
    case PlanOnBoard::unchanged: return "what was there before";
    case PlanOnBoard::restored: return "what was there before, put back";
    case PlanOnBoard::unknown: return "perhaps a mixture of old and new";
  }
  return "";
}

std::string_view to_text(ParameterRefusal refusal) {
  switch (refusal) {
    case ParameterRefusal::busy: return "another request is under way";
    case ParameterRefusal::bad_name: return "expected a name of 1 to 16 characters";
    case ParameterRefusal::bad_value: return "expected a number that the parameter's type has";
    case ParameterRefusal::not_in_mavlink_09: return "the vehicle speaks MAVLink 0.9, whose parameters are other ones";
  }
  return "";
}

std::string_view to_text(ParameterFailure failure) {
  switch (failure) {
    case ParameterFailure::none: return "";
    case ParameterFailure::silent: return "the vehicle does not answer; an ArduPilot says nothing of unknown names";
    case ParameterFailure::refused: return "the vehicle refuses";
    case ParameterFailure::differs: return "the vehicle keeps another value";
    case ParameterFailure::bad_value: return "its type has no such value";
  }
  return "";
}

std::string_view to_text(FileRefusal refusal) {
  switch (refusal) {
    case FileRefusal::busy: return "another request is under way";
    case FileRefusal::bad_path: return "expected a path that fits into a message";
    case FileRefusal::too_large: return "the file is too large";
    case FileRefusal::not_in_mavlink_09: return "the vehicle speaks MAVLink 0.9, which has no file transfer";
  }
  return "";
}

std::string_view to_text(FileFailure failure) {
  switch (failure) {
    case FileFailure::none: return "";
    case FileFailure::refused: return "the vehicle refuses";
    case FileFailure::silent: return "the vehicle does not answer; not every autopilot has files";
    case FileFailure::too_large: return "the file is too large";
  }
  return "";
}

std::string_view to_text(mavlink::FtpError error) {
  switch (error) {
    case mavlink::FtpError::fail: return "failed";
    case mavlink::FtpError::fail_errno: return "failed with an error of its system";
    case mavlink::FtpError::bad_size: return "wrong size";
    case mavlink::FtpError::bad_session: return "no such session";
    case mavlink::FtpError::no_session_free: return "no session is free";
    case mavlink::FtpError::end_of_file: return "end of the file";
    case mavlink::FtpError::unknown_command: return "unknown command";
    case mavlink::FtpError::file_exists: return "the file exists";
    case mavlink::FtpError::protected_file: return "the file is protected";
    case mavlink::FtpError::not_found: return "not found";
  }
  return "";
}

std::string mission_result_name(std::uint8_t mav_mission_result) {
  return mavlink::words_of(mavlink::autopilots::enum_info::MAV_MISSION_RESULT, mav_mission_result);
}

std::string parameter_error_name(std::uint8_t mav_param_error) {
  return mavlink::words_of(mavlink::autopilots::enum_info::MAV_PARAM_ERROR, mav_param_error);
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
