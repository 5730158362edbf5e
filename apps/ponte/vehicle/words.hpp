#pragma once

#include "ponte/autopilot/vehicle_client.hpp"

#include <string>
#include <string_view>

/// What the services of a vehicle say, for people.
namespace ponte::app {

[[nodiscard]] std::string_view to_text(autopilot::CommandError error);
[[nodiscard]] std::string_view to_text(autopilot::ModeError error);
[[nodiscard]] std::string_view to_text(autopilot::GuidedError error);
[[nodiscard]] std::string_view to_text(autopilot::StreamError error);
[[nodiscard]] std::string_view to_text(autopilot::GimbalError error);
[[nodiscard]] std::string_view to_text(autopilot::CameraError error);

/// "MAV_RESULT_DENIED", or the number of a result that has no name.
[[nodiscard]] std::string result_name(std::uint8_t mav_result);

/// Why a command was not done, as `kind` of the facts has it.
[[nodiscard]] std::string_view to_text(autopilot::CommandFact::Kind kind);
[[nodiscard]] std::string_view to_text(autopilot::ModeFact::Kind kind);
[[nodiscard]] std::string_view to_text(autopilot::StreamFact::Kind kind);
[[nodiscard]] std::string_view to_text(autopilot::ModeStep step);
template <class Wish>
[[nodiscard]] std::string_view to_text_of_wish(typename autopilot::WishFact<Wish>::Kind kind) {
  using Kind = typename autopilot::WishFact<Wish>::Kind;
  switch (kind) {
    case Kind::done: return "done";
    case Kind::refused: return "the vehicle refuses";
    case Kind::no_answer: return "the vehicle does not answer; whether it is done is not known";
    case Kind::no_effect: return "the vehicle accepts it, but nothing comes of it";
    case Kind::superseded: return "something newer was wished";
    case Kind::rebooted: return "the vehicle has started anew";
  }
  return "";
}

}  // namespace ponte::app
