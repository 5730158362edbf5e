#include "replay/dialogue.hpp"

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"

#include <zlib.h>

#include <array>
#include <string>

namespace ponte::replay {
namespace {

std::vector<std::byte> unpacked(const std::string& path) {
  std::vector<std::byte> result;
  gzFile file = gzopen(path.c_str(), "rb");
  PONTE_ASSERT(file != nullptr);
  std::array<std::byte, 1U << 16U> chunk{};
  for (int size = 1; size > 0;) {
    size = gzread(file, chunk.data(), static_cast<unsigned>(chunk.size()));
    PONTE_ASSERT(size >= 0);
    result.insert(result.end(), chunk.begin(), chunk.begin() + size);
  }
  gzclose(file);
  return result;
}

}  // namespace

Dialogue::Dialogue(std::string_view name)
    : file_{unpacked(PONTE_SOURCE_DIR "/tests/recordings/dialogues/" + std::string{name} + ".tlog.gz")} {
  mavlink::TlogReader reader{file_, autopilot::dialect};
  std::optional<WallTime> first;
  while (const auto part = reader.next()) {
    const auto* record = std::get_if<mavlink::TlogRecord>(&*part);
    if (record == nullptr) continue;  // a broken frame, which the recorder sent to see what becomes of it
    if (!first) first = record->time;
    entries_.push_back({record->time - *first, record->frame});
  }
}

}  // namespace ponte::replay
