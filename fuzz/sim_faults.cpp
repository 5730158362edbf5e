// Faults as a user writes them: whatever the text, they are read or refused, and what is read has sane times.
#include "ponte/core/assert.hpp"
#include "ponte/sim/faults.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text{reinterpret_cast<const char*>(data), size};
  const auto faults = ponte::sim::parse_faults(text);
  if (!faults) {
    PONTE_ASSERT(!faults.error().empty());
    return 0;
  }
  for (const auto& each : *faults)
    PONTE_ASSERT(each.at >= ponte::Duration{} && (!each.lasts || *each.lasts >= ponte::Duration{}));
  return 0;
}
