#include "ponte/dlisession/alert_ids.hpp"

#include <algorithm>

namespace ponte::dlisession {
namespace {

bool is_part_of_a_number(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; }

/// FNV-1a of the text without its numbers, as a positive id.
std::int32_t class_of(std::string_view text) {
  std::uint32_t hash = 2166136261U;
  for (const char c : text) {
    if (is_part_of_a_number(c)) continue;
    hash ^= static_cast<unsigned char>(c);
    hash *= 16777619U;
  }
  return static_cast<std::int32_t>(std::max<std::uint32_t>(hash & 0x7FFFFFFFU, 1));
}

}  // namespace

std::int32_t AlertIds::id_for(std::string_view text) {
  const auto id = class_of(text);
  if (std::ranges::find(seen_, id) != seen_.end()) return id;
  seen_[next_] = id;
  next_ = (next_ + 1) % capacity;
  return -id;
}

}  // namespace ponte::dlisession
