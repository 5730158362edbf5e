#include "ponte/core/degrees.hpp"
#include "vehicle/actions.hpp"
#include "vehicle/carry_out.hpp"

#include <CLI/CLI.hpp>

#include <memory>
#include <optional>

/// Gimbal and camera.
namespace ponte::app {
namespace {

using autopilot::CameraError;
using autopilot::CameraWish;
using autopilot::GimbalClient;
using autopilot::GimbalError;
using autopilot::GimbalFact;
using autopilot::GimbalWish;
using autopilot::Voice;

template <class Begin>
void wish(Operator& station, std::string_view action, Begin&& begin) {
  carry_out<GimbalWish>(station, action, begin, never_early);
}

/// By its manager, or, where there is none, as an old mount; and takes control.
void take_gimbal(Operator& station) {
  auto& gimbal = station.client().gimbal();
  const auto ask = [&](auto begin) {
    const auto request = station.begin("gimbal", begin, never_early);
    return station.await<GimbalFact>([&](const GimbalFact& fact) { return fact.request == *request; }, unheeded);
  };
  const auto found = ask([&](Voice voice) { return gimbal.find_manager(station.now(), voice); });
  const auto taken = found.kind == GimbalFact::Kind::done
                         ? ask([&](Voice voice) { return gimbal.take_control(station.now(), voice); })
                         : ask([&](Voice voice) { return gimbal.find_mount(station.now(), voice); });
  if (taken.kind != GimbalFact::Kind::done)
    station.give_up("gimbal", code_of(taken),
                    with_reason(to_text_of_wish<GimbalWish>(taken.kind), taken.reason.view()));
}

void add_pointing(CLI::App& gimbal, Action& chosen) {
  struct Options {
    double pitch{};
    double yaw{};
    bool from_north{};
  };
  auto options = std::make_shared<Options>();
  auto* action = gimbal.add_subcommand("point", "Point the gimbal");
  action->add_option("PITCH", options->pitch, "Degrees from the horizon, up positive")->required();
  action->add_option("YAW", options->yaw, "Degrees to the right of the nose");
  action->add_flag("--north", options->from_north, "The yaw counts from north");
  action->callback([&chosen, options] {
    chosen = [options](Operator& station) {
      take_gimbal(station);
      wish(station, "gimbal point", [&](Voice voice) {
        const auto frame = options->from_north ? autopilot::YawFrame::north : autopilot::YawFrame::nose;
        const autopilot::Pointing pointing{radians_from_degrees(options->pitch), radians_from_degrees(options->yaw),
                                           frame};
        return station.client().gimbal().point(station.now(), pointing, voice);
      });
    };
  });
}

void add_pictures(CLI::App& camera, Action& chosen) {
  struct Options {
    double interval{};
    std::optional<std::uint16_t> count;
  };
  auto options = std::make_shared<Options>();
  auto* action = camera.add_subcommand("pictures", "Take one picture after the other");
  action->add_option("INTERVAL", options->interval, "Seconds")->required();
  action->add_option("--count", options->count, "How many, instead of until `camera stop`");
  action->callback([&chosen, options] {
    chosen = [options](Operator& station) {
      const auto interval = std::chrono::duration_cast<Duration>(std::chrono::duration<double>{options->interval});
      carry_out<CameraWish>(
          station, "camera pictures",
          [&](Voice voice) {
            return station.client().camera().take_pictures(station.now(), interval, options->count, voice);
          },
          never_early);
    };
  });
}

}  // namespace

void add_gimbal_actions(CLI::App& command, Action& chosen) {
  auto* gimbal = command.add_subcommand("gimbal", "Point its gimbal, by a manager or as an old mount");
  gimbal->require_subcommand(1);
  add_pointing(*gimbal, chosen);
  add_simple_action(*gimbal, chosen, "release", "Let others control it", [](Operator& station) {
    take_gimbal(station);
    wish(station, "gimbal release",
         [&](Voice voice) { return station.client().gimbal().release_control(station.now(), voice); });
  });

  auto* camera = command.add_subcommand("camera", "Have its camera take pictures");
  camera->require_subcommand(1);
  add_simple_action(*camera, chosen, "picture", "Take one", [](Operator& station) {
    carry_out<CameraWish>(
        station, "camera picture",
        [&](Voice voice) { return station.client().camera().take_picture(station.now(), voice); }, never_early);
  });
  add_pictures(*camera, chosen);
  add_simple_action(*camera, chosen, "stop", "No more pictures", [](Operator& station) {
    carry_out<CameraWish>(
        station, "camera stop", [&](Voice voice) { return station.client().camera().stop(station.now(), voice); },
        never_early);
  });
}

}  // namespace ponte::app
