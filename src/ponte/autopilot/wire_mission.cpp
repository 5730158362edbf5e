#include "ponte/autopilot/wire_mission.hpp"

#include "ponte/core/degrees.hpp"
#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/vehicle/mission_command.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ponte::autopilot {
namespace {

namespace messages = mavlink::autopilots;
using Wired = Result<std::vector<WireItem>, WireRefusal>;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

bool is_local(std::uint8_t frame) {
  switch (frame) {
    case messages::MAV_FRAME_LOCAL_NED:
    case messages::MAV_FRAME_LOCAL_ENU:
    case messages::MAV_FRAME_LOCAL_OFFSET_NED:
    case messages::MAV_FRAME_BODY_NED:
    case messages::MAV_FRAME_BODY_OFFSET_NED:
    case messages::MAV_FRAME_BODY_FRD:
    case messages::MAV_FRAME_LOCAL_FRD:
    case messages::MAV_FRAME_LOCAL_FLU: return true;
    default: return false;
  }
}

/// What x and y are multiples of: 1e-7 degrees, 1e-4 m, or what the parameter itself is.
double scale_of(const vehicle::MissionCommand& command) {
  if (!vehicle::has_place(command.command)) return 1;
  return is_local(command.frame) ? 1e4 : 1e7;
}

bool is_a_global_place(const vehicle::MissionCommand& command) {
  return vehicle::has_place(command.command) && !is_local(command.frame);
}

/// Both autopilots take a place of 0, 0 for none.
Result<std::int32_t, std::string_view> wire_integer(double value, const vehicle::MissionCommand& command) {
  if (std::isnan(value)) return 0;
  const double scaled = value * scale_of(command);
  using Limits = std::numeric_limits<std::int32_t>;
  if (!(scaled >= Limits::min() && scaled <= Limits::max()))
    return fail(std::string_view{"parameter 5 or 6 is too large"});
  if (!vehicle::has_place(command.command) && scaled != std::round(scaled))
    return fail(std::string_view{"parameter 5 or 6 has no place and is not a whole number"});
  return static_cast<std::int32_t>(std::llround(scaled));
}

Result<WireItem, std::string_view> wired(Stack stack, const vehicle::MissionCommand& command, bool waits) {
  const auto x = wire_integer(command.parameters[4], command);
  if (!x) return fail(x.error());
  const auto y = wire_integer(command.parameters[5], command);
  if (!y) return fail(y.error());
  const auto parameter = [&](std::size_t index) { return static_cast<float>(command.parameters[index]); };
  WireItem item{.frame = command.frame,
                .command = command.command,
                .autocontinue = waits ? std::uint8_t{0} : std::uint8_t{1},
                .param1 = parameter(0),
                .param2 = parameter(1),
                .param3 = parameter(2),
                .param4 = parameter(3),
                .x = *x,
                .y = *y,
                .z = parameter(6)};
  // A yaw of its own choice is NaN to PX4; ArduPilot keeps 0, and refuses NaN with some commands.
  const bool is_yaw = stack != Stack::px4 && is_a_global_place(command);
  if (is_yaw && std::isnan(item.param4)) item.param4 = 0;
  return item;
}

vehicle::MissionCommand command_of(const WireItem& item) {
  vehicle::MissionCommand command{.command = item.command,
                                  .frame = item.frame,
                                  .parameters = {item.param1, item.param2, item.param3, item.param4, 0, 0, item.z}};
  if (is_a_global_place(command) && item.x == 0 && item.y == 0) {
    command.parameters[4] = command.parameters[5] = nothing;
  } else {
    command.parameters[4] = item.x / scale_of(command);
    command.parameters[5] = item.y / scale_of(command);
  }
  return command;
}

vehicle::MissionCommand at_place(unsigned command, const vehicle::Place& place, const vehicle::Altitude& altitude,
                                 double parameter1 = 0) {
  return {static_cast<std::uint16_t>(command),
          vehicle::mav_frame(altitude.above),
          {parameter1, 0, 0, 0, degrees_from_radians(place.latitude), degrees_from_radians(place.longitude),
           altitude.height.value}};
}

class Writer {
 public:
  explicit Writer(Stack stack) : stack_{stack} {}

  void add(const vehicle::MissionCommand& command, bool waits = false) {
    if (!items_) return;
    const auto item = wired(stack_, command, waits);
    if (item)
      items_->push_back(*item);
    else
      items_ = fail(WireRefusal{items_->size(), item.error()});
  }

  [[nodiscard]] Wired result() && { return std::move(items_); }

 private:
  Stack stack_;
  Wired items_;
};

Wired wire_mission(Stack stack, const vehicle::Mission& mission) {
  Writer writer{stack};
  if (mission.items.empty()) return std::move(writer).result();
  const auto first = home_items(stack, PlanType::mission);
  if (first != 0) {
    const auto home = mission.home.value_or(vehicle::Home{});
    writer.add(at_place(messages::MAV_CMD_NAV_WAYPOINT, home.place, {home.altitude_msl, vehicle::AltitudeFrame::msl}));
  }
  for (const auto& item : mission.items) {
    auto command = vehicle::express(item.action);
    if (command.command == messages::MAV_CMD_DO_JUMP) command.parameters[0] += static_cast<double>(first);
    writer.add(command, item.waits);
  }
  return std::move(writer).result();
}

Wired wire_fence(Stack stack, const vehicle::Mission& mission) {
  Writer writer{stack};
  const vehicle::Altitude ground{Metres{}, vehicle::AltitudeFrame::msl};
  if (mission.fence_return)
    writer.add(at_place(messages::MAV_CMD_NAV_FENCE_RETURN_POINT, mission.fence_return->place,
                        mission.fence_return->altitude));
  for (const auto& polygon : mission.fence_polygons) {
    const unsigned command = polygon.inclusion ? messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION
                                               : messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION;
    for (const auto& corner : polygon.corners)
      writer.add(at_place(command, corner, ground, static_cast<double>(polygon.corners.size())));
  }
  for (const auto& circle : mission.fence_circles) {
    const unsigned command =
        circle.inclusion ? messages::MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION : messages::MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION;
    writer.add(at_place(command, circle.centre, ground, circle.radius.value));
  }
  return std::move(writer).result();
}

Wired wire_rally(Stack stack, const vehicle::Mission& mission) {
  Writer writer{stack};
  for (const auto& point : mission.rally_points)
    writer.add(at_place(messages::MAV_CMD_NAV_RALLY_POINT, point.place, point.altitude));
  return std::move(writer).result();
}

vehicle::Place place_of(const WireItem& item) {
  return {radians_from_degrees(item.x / 1e7), radians_from_degrees(item.y / 1e7)};
}

vehicle::RallyPoint point_of(const WireItem& item) {
  const auto above = vehicle::altitude_frame(item.frame).value_or(vehicle::AltitudeFrame::msl);
  return {place_of(item), {Metres{item.z}, above}};
}

vehicle::Action action_of(const WireItem& item, std::size_t first, std::size_t count) {
  auto command = command_of(item);
  if (command.command != messages::MAV_CMD_DO_JUMP) return vehicle::interpret(command);
  command.parameters[0] -= static_cast<double>(first);
  auto action = vehicle::interpret(command);
  const auto* jump = std::get_if<vehicle::JumpItem>(&action);
  return jump != nullptr && jump->target >= count ? command : action;
}

void read_mission(Stack stack, std::span<const WireItem> items, vehicle::Mission& mission) {
  mission.items.clear();
  mission.patterns.clear();
  const auto first = std::min(home_items(stack, PlanType::mission), items.size());
  if (first != 0) {
    const auto& home = items.front();
    mission.home.reset();
    if (home.x != 0 || home.y != 0) mission.home = vehicle::Home{place_of(home), Metres{home.z}};
    items = items.subspan(first);
  }
  for (const auto& item : items)
    mission.items.push_back(
        {.action = action_of(item, first, items.size()), .waits = item.autocontinue == 0, .name = {}});
}

Result<void, WireRefusal> read_fence(std::span<const WireItem> items, vehicle::Mission& mission) {
  mission.fence_return.reset();
  mission.fence_polygons.clear();
  mission.fence_circles.clear();
  for (std::size_t i = 0; i < items.size();) {
    const auto& item = items[i];
    switch (item.command) {
      case messages::MAV_CMD_NAV_FENCE_RETURN_POINT: mission.fence_return = point_of(item); break;
      case messages::MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION:
      case messages::MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION:
        mission.fence_circles.push_back({.centre = place_of(item),
                                         .radius = Metres{item.param1},
                                         .inclusion = item.command == messages::MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION});
        break;
      case messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION:
      case messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION: {
        if (!(item.param1 >= 3 && item.param1 <= static_cast<float>(items.size() - i)))
          return fail(WireRefusal{i, "a polygon has fewer corners than it says, or than three"});
        const auto corners = items.subspan(i, static_cast<std::size_t>(item.param1));
        vehicle::FencePolygon polygon{
            .corners = {}, .inclusion = item.command == messages::MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION};
        for (const auto& corner : corners) {
          if (corner.command != item.command || corner.param1 != item.param1)
            return fail(WireRefusal{i, "the corners of a polygon do not belong together"});
          polygon.corners.push_back(place_of(corner));
        }
        mission.fence_polygons.push_back(std::move(polygon));
        i += corners.size();
        continue;
      }
      default: return fail(WireRefusal{i, "the command is none of a fence"});
    }
    ++i;
  }
  return {};
}

Result<void, WireRefusal> read_rally(std::span<const WireItem> items, vehicle::Mission& mission) {
  mission.rally_points.clear();
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].command != messages::MAV_CMD_NAV_RALLY_POINT)
      return fail(WireRefusal{i, "the command is not that of a rally point"});
    mission.rally_points.push_back(point_of(items[i]));
  }
  return {};
}

}  // namespace

Wired to_wire(Stack stack, PlanType type, const vehicle::Mission& mission) {
  switch (type) {
    case PlanType::mission: return wire_mission(stack, mission);
    case PlanType::fence: return wire_fence(stack, mission);
    case PlanType::rally: return wire_rally(stack, mission);
  }
  return std::vector<WireItem>{};
}

Result<void, WireRefusal> from_wire(Stack stack, PlanType type, std::span<const WireItem> items,
                                    vehicle::Mission& mission) {
  switch (type) {
    case PlanType::mission: read_mission(stack, items, mission); return {};
    case PlanType::fence: return read_fence(items, mission);
    case PlanType::rally: return read_rally(items, mission);
  }
  return {};
}

}  // namespace ponte::autopilot
