#include "ponte/planning/formats/coordinates.hpp"
#include "ponte/planning/formats/json_tree.hpp"
#include "ponte/planning/formats/numbered_items.hpp"
#include "ponte/planning/formats/plan.hpp"
#include "ponte/planning/formats/refusal.hpp"
#include "ponte/planning/formats/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <utility>

namespace ponte::planning {
namespace {

constexpr std::size_t highest_byte = 255;
constexpr std::size_t highest_word = 65535;

bool is_null(const JsonValue* value) { return value == nullptr || value->kind == JsonValue::Kind::null; }

bool truth_of(const JsonValue& value, std::string_view name) {
  if (value.kind != JsonValue::Kind::boolean)
    refuse(at_line(value.line), fmt::format("{} is {}", name, shown(value)), "true or false");
  return value.truth;
}

std::size_t integer_member(const JsonValue& object, std::string_view name, std::size_t highest) {
  const auto& value = member_of(object, name);
  return integer_of(number_of(value, name), highest, name, at_line(value.line));
}

/// What the members of other versions mean, nobody can tell.
void check_version(const JsonValue& object, std::string_view name, std::size_t version) {
  const auto& value = member_of(object, "version");
  if (number_of(value, "version") != static_cast<double>(version))
    refuse(at_line(value.line), fmt::format("the version of {} is {}", name, shown(value)), fmt::format("{}", version));
}

/// An array of `count` numbers.
const std::vector<JsonValue>& numbers_of(const JsonValue& value, std::string_view name, std::size_t count) {
  const auto& numbers = elements_of(value, name);
  if (numbers.size() != count)
    refuse(at_line(value.line), fmt::format("{} has {} numbers", name, numbers.size()), fmt::format("{}", count));
  return numbers;
}

/// The place that the first two of these numbers are.
vehicle::Place place_of_numbers(const std::vector<JsonValue>& numbers) {
  return checked_place(number_of(numbers[0], "latitude"), number_of(numbers[1], "longitude"), at_line(numbers[0].line));
}

vehicle::RallyPoint rally_point(const JsonValue& value, std::string_view name) {
  const auto& numbers = numbers_of(value, name, 3);
  return {place_of_numbers(numbers), {Metres{number_of(numbers[2], "altitude")}, vehicle::AltitudeFrame::home}};
}

class PlanReader {
 public:
  explicit PlanReader(std::string_view text) : text_{text} {}

  Reading read(const JsonValue& root) {
    if (text_of(member_of(root, "fileType"), "fileType") != "Plan")
      refuse(at_line(root.line), fmt::format("fileType is {}", shown(member_of(root, "fileType"))), "\"Plan\"");
    check_version(root, "the plan", 1);
    remark_others(root, {"fileType", "version", "groundStation", "mission", "geoFence", "rallyPoints"});
    read_mission(member_of(root, "mission"));
    if (const auto* fence = root.find("geoFence")) read_fence(*fence);
    if (const auto* rally = root.find("rallyPoints")) read_rally_points(*rally);
    add_items(items_, reading_);
    return std::move(reading_);
  }

 private:
  vehicle::Mission& mission() { return reading_.content.mission; }
  void remark(const JsonValue& value, std::string text) {
    reading_.remarks.push_back({at_line(value.line), std::move(text)});
  }

  void remark_others(const JsonValue& object, std::initializer_list<std::string_view> known) {
    for (const auto& value : object.elements)
      if (std::ranges::find(known, value.name) == known.end())
        remark(value, fmt::format("'{}' is not kept", value.name));
  }

  void read_mission(const JsonValue& object) {
    check_version(object, "mission", 2);
    remark_others(object, {"version", "firmwareType", "vehicleType", "cruiseSpeed", "hoverSpeed",
                           "globalPlanAltitudeMode", "plannedHomePosition", "items"});
    if (!is_null(object.find("firmwareType")))
      mission().autopilot = static_cast<std::uint8_t>(integer_member(object, "firmwareType", highest_byte));
    if (!is_null(object.find("vehicleType")))
      mission().airframe = static_cast<std::uint8_t>(integer_member(object, "vehicleType", highest_byte));
    if (const auto* speed = object.find("cruiseSpeed"); !is_null(speed))
      mission().cruise_speed = MetresPerSecond{number_of(*speed, "cruiseSpeed")};
    if (const auto* speed = object.find("hoverSpeed"); !is_null(speed))
      mission().hover_speed = MetresPerSecond{number_of(*speed, "hoverSpeed")};
    if (const auto* home = object.find("plannedHomePosition"); !is_null(home)) read_home(*home);
    for (const auto& item : elements_of(member_of(object, "items"), "items")) read_item(item);
  }

  void read_home(const JsonValue& value) {
    const auto& numbers = numbers_of(value, "plannedHomePosition", 3);
    if (is_null(&numbers[0]) && is_null(&numbers[1])) return;
    if (is_null(&numbers[2])) {
      remark(value, "the home position is not kept, since it has no altitude");
      return;
    }
    mission().home = vehicle::Home{place_of_numbers(numbers), Metres{number_of(numbers[2], "altitude")}};
  }

  void read_item(const JsonValue& item) {
    const auto& type = member_of(item, "type");
    if (text_of(type, "type") == "SimpleItem")
      read_simple(item);
    else if (type.text == "ComplexItem")
      read_complex(item);
    else
      refuse(at_line(type.line), fmt::format("type is {}", shown(type)), "\"SimpleItem\" or \"ComplexItem\"");
  }

  void read_simple(const JsonValue& object) {
    remark_others(object, {"type", "command", "frame", "params", "autoContinue", "doJumpId", "Altitude", "AltitudeMode",
                           "AMSLAltAboveTerrain"});
    constexpr double above_terrain_when_planned = 3;
    if (const auto* mode = object.find("AltitudeMode"); !is_null(mode) && mode->number == above_terrain_when_planned)
      remark(*mode, "that the altitude was calculated from terrain is not kept");
    NumberedItem item{.number = items_.size() + 1, .command = {}, .name = {}, .where = at_line(object.line)};
    if (!is_null(object.find("doJumpId"))) item.number = integer_member(object, "doJumpId", highest_word);
    item.command.command = static_cast<std::uint16_t>(integer_member(object, "command", highest_word));
    item.command.frame = static_cast<std::uint8_t>(integer_member(object, "frame", highest_byte));
    item.waits = !truth_of(member_of(object, "autoContinue"), "autoContinue");
    const auto& parameters = numbers_of(member_of(object, "params"), "params", item.command.parameters.size());
    std::ranges::transform(parameters, item.command.parameters.begin(), [](const JsonValue& value) {
      return is_null(&value) ? std::numeric_limits<double>::quiet_NaN() : number_of(value, "a parameter");
    });
    items_.push_back(std::move(item));
  }

  void read_complex(const JsonValue& object) {
    vehicle::Pattern pattern{.first = items_.size(), .count = 0, .kind = {}, .text = {}};
    pattern.kind = text_of(member_of(object, "complexItemType"), "complexItemType");
    pattern.text = text_.substr(object.begin, object.end - object.begin);
    if (const auto* transects = object.find("TransectStyleComplexItem"))
      if (const auto* items = transects->find("Items"))
        for (const auto& item : elements_of(*items, "Items")) read_simple(item);
    pattern.count = items_.size() - pattern.first;
    // Its text is written again as it is, so the numbers in it must be those of its places.
    for (std::size_t i = pattern.first; i < items_.size(); ++i) {
      if (items_[i].number == i + 1) continue;
      remark(object,
             fmt::format("the items of the {} are not numbered by their places: it becomes its items", pattern.kind));
      return;
    }
    mission().patterns.push_back(std::move(pattern));
  }

  void read_fence(const JsonValue& object) {
    check_version(object, "geoFence", 2);
    remark_others(object, {"version", "circles", "polygons", "breachReturn"});
    if (const auto* polygons = object.find("polygons"))
      for (const auto& polygon : elements_of(*polygons, "polygons")) read_fence_polygon(polygon);
    if (const auto* circles = object.find("circles"))
      for (const auto& circle : elements_of(*circles, "circles")) read_fence_circle(circle);
    if (const auto* point = object.find("breachReturn"); !is_null(point))
      mission().fence_return = rally_point(*point, "breachReturn");
  }

  void read_fence_polygon(const JsonValue& object) {
    check_version(object, "a fence polygon", 1);
    remark_others(object, {"version", "polygon", "inclusion"});
    vehicle::FencePolygon polygon{.corners = {}, .inclusion = truth_of(member_of(object, "inclusion"), "inclusion")};
    for (const auto& corner : elements_of(member_of(object, "polygon"), "polygon"))
      polygon.corners.push_back(place_of_numbers(numbers_of(corner, "a corner", 2)));
    if (polygon.corners.size() < 3)
      refuse(at_line(object.line), fmt::format("a fence has {} corners", polygon.corners.size()), "at least 3");
    mission().fence_polygons.push_back(std::move(polygon));
  }

  void read_fence_circle(const JsonValue& object) {
    check_version(object, "a fence circle", 1);
    remark_others(object, {"version", "circle", "inclusion"});
    const auto& circle = member_of(object, "circle");
    const auto& radius = member_of(circle, "radius");
    if (!(number_of(radius, "radius") > 0))
      refuse(at_line(radius.line), fmt::format("the radius of a fence is {}", shown(radius)), "more than 0 metres");
    mission().fence_circles.push_back({place_of_numbers(numbers_of(member_of(circle, "center"), "center", 2)),
                                       Metres{radius.number}, truth_of(member_of(object, "inclusion"), "inclusion")});
  }

  void read_rally_points(const JsonValue& object) {
    check_version(object, "rallyPoints", 2);
    remark_others(object, {"version", "points"});
    for (const auto& point : elements_of(member_of(object, "points"), "points"))
      mission().rally_points.push_back(rally_point(point, "a rally point"));
  }

  std::string_view text_;
  std::vector<NumberedItem> items_;
  Reading reading_;
};

}  // namespace

ReadingResult read_plan(Bytes bytes, const ReadOptions&) try {
  const auto text = text_in(bytes);
  const auto root = parse_json(text);
  return PlanReader{text}.read(root);
} catch (const FormatError& error) {
  return fail(error);
}

}  // namespace ponte::planning
