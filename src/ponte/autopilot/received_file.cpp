#include "ponte/autopilot/received_file.hpp"

#include <algorithm>

namespace ponte::autopilot {

void ReceivedFile::clear() {
  content_.clear();
  gaps_.clear();
}

bool ReceivedFile::add(std::size_t offset, Bytes piece) {
  if (piece.empty()) return true;
  const auto end = offset + piece.size();
  if (end > size_limit_) return false;
  if (offset > content_.size()) {
    if (gaps_.size() == most_gaps) return false;
    gaps_.push_back({content_.size(), offset});
  }
  if (end > content_.size()) content_.resize(end);
  std::ranges::copy(piece, content_.begin() + static_cast<std::ptrdiff_t>(offset));

  std::vector<Gap> left;
  for (const auto& gap : gaps_) {
    if (const auto before = std::min(gap.end, offset); gap.begin < before) left.push_back({gap.begin, before});
    if (const auto after = std::max(gap.begin, end); after < gap.end) left.push_back({after, gap.end});
  }
  gaps_ = std::move(left);
  return gaps_.size() <= most_gaps;
}

std::optional<ReceivedFile::Gap> ReceivedFile::first_gap() const {
  if (gaps_.empty()) return std::nullopt;
  return gaps_.front();
}

}  // namespace ponte::autopilot
