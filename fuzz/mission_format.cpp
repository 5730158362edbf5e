// One format of points or missions, PONTE_FORMAT, over any bytes: what is read can be written, and is then read as the
// same.

#include "ponte/core/assert.hpp"
#include "ponte/planning/formats/format.hpp"

#include <cstddef>
#include <cstdint>
#include <span>

using namespace ponte::planning;

namespace {

/// No format of missions keeps the names of items.
MissionFile without_item_names(MissionFile content) {
  for (auto& item : content.mission.items) item.name.clear();
  return content;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr auto format = Format::PONTE_FORMAT;
  const auto bytes = std::as_bytes(std::span{data, size});
  (void)detect_format(bytes, "");
  const auto reading = read_mission_file(format, bytes);
  if (!reading) {
    PONTE_ASSERT(!reading.error().what.empty() && !reading.error().expectation.empty());
    return 0;
  }
  const auto content = without_item_names(reading->content);
  const auto writing = write_mission_file(format, content);
  PONTE_ASSERT(writing && writing->losses.empty());
  const ReadOptions options{.poi_layout = PoiLayout::f64_le, .altitude_above = {}};
  const auto again = read_mission_file(format, writing->bytes, options);
  PONTE_ASSERT(again && again->content == content);
  return 0;
}
