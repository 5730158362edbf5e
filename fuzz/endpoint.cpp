// The grammar of endpoints over any text.

#include "ponte/transport/endpoint.hpp"
#include "ponte/core/assert.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

using namespace ponte::transport;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text{reinterpret_cast<const char*>(data), size};
  if (const auto endpoint = parse_endpoint(text)) {
    const auto again = parse_endpoint(to_text(*endpoint));
    PONTE_ASSERT(again == *endpoint);
  } else {
    const auto& error = endpoint.error();
    PONTE_ASSERT(!error.expectation.empty());
    PONTE_ASSERT(error.position <= text.size());
    PONTE_ASSERT(text.substr(error.position, error.part.size()) == error.part);
  }
  return 0;
}
