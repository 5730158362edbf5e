#include "ponte/autopilot/plan_file.hpp"

#include "ponte/core/assert.hpp"
#include "ponte/mavlink/codec.hpp"

#include <limits>

namespace ponte::autopilot {
namespace {

constexpr std::uint16_t magic = 0x763D;
constexpr std::size_t header_size = 10;
constexpr std::size_t item_size = WireItem::info.full_length;

}  // namespace

std::string_view plan_path(PlanType type) {
  switch (type) {
    case PlanType::mission: return "@MISSION/mission.dat";
    case PlanType::fence: return "@MISSION/fence.dat";
    case PlanType::rally: return "@MISSION/rally.dat";
  }
  return {};
}

std::vector<std::byte> pack_plan(PlanType type, std::span<const WireItem> items) {
  PONTE_ASSERT(items.size() <= std::numeric_limits<std::uint16_t>::max());
  std::vector<std::byte> file(header_size + items.size() * item_size);
  store_le(&file[0], magic);
  store_le(&file[2], static_cast<std::uint16_t>(type));
  store_le(&file[8], static_cast<std::uint16_t>(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto item = items[i];
    item.seq = static_cast<std::uint16_t>(i);
    item.mission_type = static_cast<std::uint8_t>(type);
    auto* const to = file.data() + header_size + i * item_size;
    WireItem::visit(item, [to](const mavlink::FieldInfo& field, const auto& value) {
      mavlink::detail::store_field(field, to + field.offset, value);
    });
  }
  return file;
}

Result<std::vector<WireItem>, PlanFileError> unpack_plan(PlanType type, Bytes file) {
  const auto refuse = [](std::string_view what) { return fail(PlanFileError{what}); };
  if (file.size() < header_size) return refuse("the header is cut off");
  if (u16_le(file, 0) != magic) return refuse("it does not begin with the magic number");
  if (u16_le(file, 2) != static_cast<unsigned>(type)) return refuse("it has another type of plan");
  if (u16_le(file, 6) != 0) return refuse("it begins in the middle of the plan");
  const std::size_t count = u16_le(file, 8);
  if (file.size() != header_size + count * item_size) return refuse("its size is not that of its items");
  std::vector<WireItem> items;
  for (std::size_t i = 0; i < count; ++i)
    items.push_back(mavlink::decode<WireItem>(file.subspan(header_size + i * item_size, item_size)));
  return items;
}

}  // namespace ponte::autopilot
