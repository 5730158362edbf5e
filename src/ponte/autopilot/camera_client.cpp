#include "ponte/autopilot/camera_client.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"

namespace ponte::autopilot {

namespace messages = mavlink::autopilots;

Result<CameraRequestId, CameraError> CameraClient::take_picture(Timestamp now, Voice& voice) {
  return ask(now, CameraWish::take_picture,
             {.number = messages::MAV_CMD_IMAGE_START_CAPTURE, .param3 = 1, .param4 = static_cast<float>(++sequence_)},
             voice);
}

Result<CameraRequestId, CameraError> CameraClient::take_pictures(Timestamp now, Duration interval,
                                                                 std::optional<std::uint16_t> count, Voice& voice) {
  if (interval <= Duration{} || count == 0) return fail(CameraError::invalid);
  return ask(now, CameraWish::take_pictures,
             {.number = messages::MAV_CMD_IMAGE_START_CAPTURE,
              .param2 = std::chrono::duration<float>{interval}.count(),
              .param3 = static_cast<float>(count.value_or(0))},  // 0: until it is stopped
             voice);
}

Result<CameraRequestId, CameraError> CameraClient::stop(Timestamp now, Voice& voice) {
  return ask(now, CameraWish::stop, {.number = messages::MAV_CMD_IMAGE_STOP_CAPTURE}, voice);
}

Result<CameraRequestId, CameraError> CameraClient::ask(Timestamp now, CameraWish wish, const Command& command,
                                                       Voice& voice) {
  const auto request = wishes_.ask(now, wish, command, {}, voice);
  if (!request) return fail(CameraError::not_sent);
  return *request;
}

bool CameraClient::on_answer(Timestamp now, const CommandFact& answer, Outbox<CameraFact>& facts) {
  if (!wishes_.on_answer(now, answer, facts)) return false;
  wishes_.look(
      now, [](CameraWish, Timestamp) { return true; }, facts);
  return true;
}

}  // namespace ponte::autopilot
