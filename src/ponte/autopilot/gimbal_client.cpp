#include "ponte/autopilot/gimbal_client.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/gimbal_device_attitude_status.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_information.hpp"
#include "ponte/mavlink/autopilots/gimbal_manager_status.hpp"
#include "ponte/mavlink/autopilots/mount_orientation.hpp"
#include "ponte/mavlink/codec.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float leave_as_it_is = -1;
constexpr float give_up_if_ours = -3;

float degrees(const std::optional<Radians>& angle) {
  return angle ? static_cast<float>(degrees_from_radians(*angle)) : nan;
}

bool is_valid(const std::optional<Radians>& angle) { return !angle || std::abs(angle->value) <= 2 * std::numbers::pi; }

/// Wishes of where it is to point, of which the newest counts.
bool directs(GimbalWish wish) { return wish == GimbalWish::point || wish == GimbalWish::look_at; }

/// If neither frame is named, a locked yaw counts from north.
YawFrame frame_of(std::uint16_t flags) {
  const bool names_frame = (flags & (messages::GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME |
                                     messages::GIMBAL_DEVICE_FLAGS_YAW_IN_VEHICLE_FRAME)) != 0;
  const auto earth =
      names_frame ? messages::GIMBAL_DEVICE_FLAGS_YAW_IN_EARTH_FRAME : messages::GIMBAL_DEVICE_FLAGS_YAW_LOCK;
  return (flags & earth) != 0 ? YawFrame::north : YawFrame::nose;
}

}  // namespace

GimbalClient::GimbalClient(CommandClient& commands) : commands_{commands}, wishes_{commands} {}

Result<GimbalRequestId, GimbalError> GimbalClient::find_manager(Timestamp now, Voice& voice) {
  const auto id = messages::GimbalManagerInformation::info.id.value;
  return ask(now, GimbalWish::find_manager,
             {.number = messages::MAV_CMD_REQUEST_MESSAGE, .param1 = static_cast<float>(id)}, voice);
}

Result<GimbalRequestId, GimbalError> GimbalClient::find_mount(Timestamp now, Voice& voice) {
  return ask(now, GimbalWish::find_mount,
             {.number = messages::MAV_CMD_DO_MOUNT_CONFIGURE,
              .param1 = static_cast<float>(messages::MAV_MOUNT_MODE_MAVLINK_TARGETING),
              .param2 = 1,   // roll,
              .param3 = 1},  // and pitch are kept level
             voice);
}

Result<GimbalRequestId, GimbalError> GimbalClient::take_control(Timestamp now, Voice& voice) {
  return configure(now, GimbalWish::take_control, voice.system().value, voice.component().value, voice);
}

Result<GimbalRequestId, GimbalError> GimbalClient::release_control(Timestamp now, Voice& voice) {
  return configure(now, GimbalWish::release_control, give_up_if_ours, give_up_if_ours, voice);
}

Result<GimbalRequestId, GimbalError> GimbalClient::configure(Timestamp now, GimbalWish wish, float system,
                                                             float component, Voice& voice) {
  if (kind_ == Kind::none) return fail(GimbalError::not_found);
  if (kind_ == Kind::mount) return fail(GimbalError::not_supported);
  return ask(now, wish,
             {.number = messages::MAV_CMD_DO_GIMBAL_MANAGER_CONFIGURE,
              .param1 = system,
              .param2 = component,
              .param3 = leave_as_it_is,
              .param4 = leave_as_it_is,
              .z = static_cast<float>(device_)},
             voice);
}

std::optional<GimbalError> GimbalClient::refusal() const {
  if (kind_ == Kind::none) return GimbalError::not_found;
  if (kind_ == Kind::manager && !is_in_control_) return GimbalError::not_in_control;
  return std::nullopt;
}

/// Roll and pitch count from the horizon in any case.
Command GimbalClient::pitch_yaw(YawFrame frame) const {
  const unsigned yaw = frame == YawFrame::north
                           ? messages::GIMBAL_MANAGER_FLAGS_YAW_LOCK | messages::GIMBAL_MANAGER_FLAGS_YAW_IN_EARTH_FRAME
                           : messages::GIMBAL_MANAGER_FLAGS_YAW_IN_VEHICLE_FRAME;
  const unsigned flags = messages::GIMBAL_MANAGER_FLAGS_ROLL_LOCK | messages::GIMBAL_MANAGER_FLAGS_PITCH_LOCK | yaw;
  return {.number = messages::MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW,
          .param1 = nan,
          .param2 = nan,
          .param3 = nan,
          .param4 = nan,
          .x = static_cast<double>(flags),
          .z = static_cast<float>(device_)};
}

Result<GimbalRequestId, GimbalError> GimbalClient::point(Timestamp now, const Pointing& pointing, Voice& voice) {
  if (const auto error = refusal()) return fail(*error);
  if (!is_valid(pointing.pitch) || !is_valid(pointing.yaw)) return fail(GimbalError::invalid);
  if (kind_ == Kind::manager) {
    auto command = pitch_yaw(pointing.frame);
    command.param1 = degrees(pointing.pitch);
    command.param2 = degrees(pointing.yaw);
    return ask(now, GimbalWish::point, command, voice);
  }
  if (!pointing.pitch || !pointing.yaw || pointing.frame != YawFrame::nose) return fail(GimbalError::not_supported);
  return ask(now, GimbalWish::point,
             {.number = messages::MAV_CMD_DO_MOUNT_CONTROL,
              .param1 = degrees(pointing.pitch),
              .param3 = degrees(pointing.yaw),
              .z = static_cast<float>(messages::MAV_MOUNT_MODE_MAVLINK_TARGETING)},
             voice);
}

Result<GimbalRequestId, GimbalError> GimbalClient::turn(Timestamp now, const Turning& turning, Voice& voice) {
  if (const auto error = refusal()) return fail(*error);
  if (!std::isfinite(turning.pitch.value) || !std::isfinite(turning.yaw.value)) return fail(GimbalError::invalid);
  if (kind_ == Kind::mount) return fail(GimbalError::not_supported);
  auto command = pitch_yaw(turning.frame);
  command.param3 = static_cast<float>(degrees_from_radians(Radians{turning.pitch.value}));
  command.param4 = static_cast<float>(degrees_from_radians(Radians{turning.yaw.value}));
  return ask(now, GimbalWish::point, command, voice);
}

Result<GimbalRequestId, GimbalError> GimbalClient::look_at(Timestamp now, const std::optional<Target>& place,
                                                           Voice& voice) {
  if (const auto error = refusal()) return fail(*error);
  if (!place) return ask(now, GimbalWish::look_at, {.number = messages::MAV_CMD_DO_SET_ROI_NONE}, voice);
  if (!is_valid(*place)) return fail(GimbalError::invalid);
  Command command{.number = messages::MAV_CMD_DO_SET_ROI_LOCATION};
  set_place(command, *place);
  return ask(now, GimbalWish::look_at, command, voice);
}

Result<GimbalRequestId, GimbalError> GimbalClient::ask(Timestamp now, GimbalWish wish, const Command& command,
                                                       Voice& voice) {
  if (directs(wish)) wishes_.supersede(now, directs);
  const auto request = wishes_.ask(now, wish, command, patience, voice);
  if (!request) return fail(GimbalError::not_sent);
  return *request;
}

void GimbalClient::on_message(Timestamp now, const mavlink::FrameView& frame, const Voice& voice,
                              Outbox<GimbalFact>& facts) {
  if (frame.system != commands_.peer().system) return;
  if (mavlink::carries<messages::GimbalManagerInformation>(frame)) {
    const auto information = mavlink::decode<messages::GimbalManagerInformation>(frame);
    kind_ = Kind::manager;
    device_ = information.gimbal_device_id;
    capabilities_ = information.cap_flags;
    found_at_ = now;
  }
  if (mavlink::carries<messages::GimbalManagerStatus>(frame)) {
    const auto status = mavlink::decode<messages::GimbalManagerStatus>(frame);
    if (kind_ == Kind::manager && status.gimbal_device_id != device_) return;  // of another gimbal
    is_in_control_ = status.primary_control_sysid == voice.system().value &&
                     status.primary_control_compid == voice.component().value;
    status_at_ = now;
  }
  if (mavlink::carries<messages::GimbalDeviceAttitudeStatus>(frame)) {
    const auto status = mavlink::decode<messages::GimbalDeviceAttitudeStatus>(frame);
    const auto [w, x, y, z] = status.q;
    const double sine = std::clamp(2.0 * (double{w} * y - double{z} * x), -1.0, 1.0);
    const double yaw = std::atan2(2.0 * (double{w} * z + double{x} * y), 1 - 2.0 * (double{y} * y + double{z} * z));
    if (std::isfinite(sine) && std::isfinite(yaw))
      attitude_ = Attitude{Radians{std::asin(sine)}, Radians{yaw}, frame_of(status.flags), now};
  }
  if (mavlink::carries<messages::MountOrientation>(frame)) {
    const auto status = mavlink::decode<messages::MountOrientation>(frame);
    if (std::isfinite(status.pitch) && std::isfinite(status.yaw))
      attitude_ = Attitude{radians_from_degrees(double{status.pitch}), radians_from_degrees(double{status.yaw}),
                           YawFrame::nose, now};
  }
  on_tick(now, facts);
}

bool GimbalClient::on_answer(Timestamp now, const CommandFact& answer, Outbox<GimbalFact>& facts) {
  if (!wishes_.on_answer(now, answer, facts)) return false;
  const bool is_mount =
      answer.kind == CommandFact::Kind::accepted && answer.command == messages::MAV_CMD_DO_MOUNT_CONFIGURE;
  if (is_mount && kind_ == Kind::none) kind_ = Kind::mount;
  on_tick(now, facts);
  return true;
}

void GimbalClient::on_tick(Timestamp now, Outbox<GimbalFact>& facts) {
  wishes_.look(
      now, [this](GimbalWish wish, Timestamp since) { return is_seen(wish, since); }, facts);
}

bool GimbalClient::is_seen(GimbalWish wish, Timestamp since) const {
  switch (wish) {
    case GimbalWish::find_manager: return kind_ == Kind::manager && found_at_ > since;
    case GimbalWish::take_control: return is_in_control_ && status_at_ > since;
    case GimbalWish::release_control: return !is_in_control_ && status_at_ > since;
    case GimbalWish::find_mount:
    case GimbalWish::point:
    case GimbalWish::look_at: return true;
  }
  return true;
}

void GimbalClient::on_reboot(Timestamp now, Outbox<GimbalFact>& facts) {
  wishes_.on_reboot(now, facts);
  kind_ = Kind::none;
  capabilities_ = 0;
  is_in_control_ = false;
  attitude_.reset();
}

}  // namespace ponte::autopilot
