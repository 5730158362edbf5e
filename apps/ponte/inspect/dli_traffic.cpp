#include "inspect/dli_traffic.hpp"

namespace ponte::app {

std::string_view name_of(dli::WrapperError error) {
  switch (error) {
    case dli::WrapperError::truncated: return "truncated";
    case dli::WrapperError::bad_length: return "bad length";
    case dli::WrapperError::beyond_end: return "beyond end";
    case dli::WrapperError::unassigned_checksum: return "unassigned checksum";
    case dli::WrapperError::bad_checksum: return "bad checksum";
    case dli::WrapperError::stray_bytes: return "stray bytes";
  }
  return "";
}

}  // namespace ponte::app
