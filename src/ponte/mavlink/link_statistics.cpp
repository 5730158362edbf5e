#include "ponte/mavlink/link_statistics.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace ponte::mavlink {
namespace {

constexpr unsigned history = std::numeric_limits<decltype(SenderStatistics::recent)>::digits;

void on_sequence(SenderStatistics& sender, std::uint8_t sequence) {
  ++sender.received;
  const auto behind = static_cast<std::uint8_t>(sender.last_sequence - sequence);
  if (behind < history) {
    const auto bit = std::uint32_t{1} << behind;
    if ((sender.recent & bit) != 0) {
      ++sender.duplicates;
    } else if (sender.lost() > 0) {
      ++sender.late;
    }
    sender.recent |= bit;
    return;
  }
  const auto ahead = static_cast<std::uint8_t>(sequence - sender.last_sequence);
  sender.missed += ahead - 1U;
  sender.recent = (ahead < history ? sender.recent << ahead : 0) | 1U;
  sender.last_sequence = sequence;
}

}  // namespace

void LinkStatistics::on_frame(SystemId system, ComponentId component, std::uint8_t sequence) {
  const auto key = std::pair{system, component};
  const auto end = senders_.begin() + static_cast<std::ptrdiff_t>(size_);
  const auto at = std::lower_bound(senders_.begin(), end, key, [](const SenderStatistics& sender, const auto& wanted) {
    return std::pair{sender.system, sender.component} < wanted;
  });
  if (at != end && std::pair{at->system, at->component} == key) return on_sequence(*at, sequence);
  if (size_ == capacity) {
    ++frames_not_counted_;
    return;
  }
  std::move_backward(at, end, end + 1);
  *at = {.system = system, .component = component, .last_sequence = sequence, .received = 1};
  ++size_;
}

}  // namespace ponte::mavlink
