#include "ponte/mavlink/rate_limit.hpp"

#include <algorithm>

namespace ponte::mavlink {

bool RateLimit::admits(Timestamp now, SystemId system, ComponentId component) {
  if (!pause_) return false;
  const auto end = senders_.begin() + static_cast<std::ptrdiff_t>(size_);
  auto sender = std::find_if(senders_.begin(), end, [&](const Sender& other) {
    return other.system == system && other.component == component;
  });
  if (sender != end) {
    if (now < sender->next) return false;
  } else {
    if (size_ == sender_limit) {
      // One whose pause is over may be forgotten: it would be let through anyway.
      sender = std::ranges::min_element(senders_, {}, &Sender::next);
      if (now < sender->next) return false;
    } else {
      ++size_;
    }
    *sender = {system, component, now};
  }
  sender->next = std::max(sender->next + *pause_, now);
  return true;
}

}  // namespace ponte::mavlink
