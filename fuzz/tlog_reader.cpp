// The reader of recordings over any bytes. The first input byte chooses whether checksums are repaired.

#include "ponte/autopilot/dialect.hpp"
#include "ponte/core/assert.hpp"
#include "ponte/mavlink/tlog.hpp"
#include "repair_checksums.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

using namespace ponte;
using namespace ponte::mavlink;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto input = std::as_bytes(std::span{data, size});
  if (input.empty()) return 0;
  std::vector<std::byte> file(input.begin() + 1, input.end());
  if ((u8(input, 0) & 1U) != 0) repair_checksums(file, autopilot::dialect);

  TlogReader reader{file, autopilot::dialect};
  std::size_t position = 0;
  while (const auto part = reader.next()) {
    if (const auto* record = std::get_if<TlogRecord>(&*part)) {
      PONTE_ASSERT(record->offset == position);
      PONTE_ASSERT(record->message == find_message(autopilot::dialect, record->frame));
      PONTE_ASSERT(record->message == nullptr || checksum_matches(record->frame, record->message->crc_extra));
      std::vector<std::byte> again;
      append_record(again, record->time, record->frame.whole);
      PONTE_ASSERT(again.size() <= file.size() - position);
      PONTE_ASSERT(std::equal(again.begin(), again.end(), file.begin() + static_cast<std::ptrdiff_t>(position)));
      position += again.size();
    } else {
      const auto& damage = std::get<TlogDamage>(*part);
      PONTE_ASSERT(damage.offset == position);
      PONTE_ASSERT(damage.length > 0 && damage.length <= file.size() - position);
      position += damage.length;
    }
  }
  PONTE_ASSERT(position == file.size());
  return 0;
}
