#pragma once

#include "ponte/autopilot/test_frames.hpp"
#include "ponte/dli/codec.hpp"
#include "ponte/dli/datagram.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/dli/messages/heartbeat_message.hpp"
#include "ponte/dli/messages/inertial_states.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/vsm/view/bridge_view.hpp"

#include <nlohmann/json.hpp>

#include <vector>

/// For the tests of this folder.
namespace ponte::vsm::view::testing {

using nlohmann::json;
using namespace std::chrono_literals;

inline constexpr VehicleLinkId radio{1};
inline constexpr mavlink::SystemId vehicle_system{1};
inline constexpr dli::EntityId vehicle_id{20, dli::EntityType::vehicle, 1};
inline constexpr dli::EntityId vsm_id{20, dli::EntityType::vsm, 1};
inline constexpr WallTime wall = wall_time_from_unix_us(1'700'000'000'000'000);

template <dli::Message M>
OutgoingMessage sent(dli::EntityId source, const M& message) {
  OutgoingMessage result{.time = wall};
  const dli::Profile profile;
  dli::DatagramWriter writer{result.buffer, profile};
  const auto written = dli::add_message(writer, {.source = source, .destination = dli::broadcast_id}, message);
  PONTE_ASSERT(written.has_value());
  result.size = writer.bytes().size();
  return result;
}

/// A view of one vehicle on one link, and a clock that the test moves.
class ViewBench {
 public:
  ViewBench() {
    view.set_situation({.converts = true,
                        .vehicle_links = {{.id = radio, .endpoint = "udpin://0.0.0.0:14550", .is_up = true}},
                        .vehicles = {{.id = vehicle_id, .link = radio, .system = vehicle_system, .is_present = true}}});
  }

  /// A frame crosses the bridge; each stage takes 10 us.
  template <class M>
  void cross(const M& message, std::vector<OutgoingMessage> became = {},
             mavlink::SystemId system = vehicle_system, mavlink::ComponentId component = mavlink::ComponentId{1}) {
    const autopilot::testing::TestFrame frame{message, system, component};
    view.on_crossing({.link_id = radio,
                      .link = "udpin://0.0.0.0:14550",
                      .time = wall,
                      .frame = frame.view(),
                      .message = &M::info,
                      .messages = became,
                      .received = now,
                      .decoded = now + 10us,
                      .translated = now + 20us,
                      .sent = now + 30us});
  }

  json crossings(std::uint64_t since = 0) {
    view.on_tick(now);
    const auto news = view.crossings(vehicle_id, since);
    return news.text ? json::parse(*news.text).at("crossings") : json::array();
  }
  json traffic(std::uint64_t since = 0) {
    view.on_tick(now);
    const auto news = view.traffic(since, now);
    return news.text ? json::parse(*news.text) : json{};
  }
  json status() {
    view.on_tick(now);
    return json::parse(*view.status(now));
  }

  BridgeView view{dli::messages::catalogue, {}};
  Timestamp now{Duration{1h}};
};

}  // namespace ponte::vsm::view::testing
