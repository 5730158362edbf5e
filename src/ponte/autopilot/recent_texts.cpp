#include "ponte/autopilot/recent_texts.hpp"

#include <algorithm>

namespace ponte::autopilot {

void RecentTexts::on_text(Timestamp now, const mavlink::autopilots::Statustext& text) {
  assembler_.on_chunk(now, text.severity, text.id, text.chunk_seq, text.text.view(),
                      [&](const vehicle::Alert& alert) { keep(now, alert); });
}

void RecentTexts::on_tick(Timestamp now) {
  assembler_.on_tick(now, [&](const vehicle::Alert& alert) { keep(now, alert); });
}

void RecentTexts::forget() {
  assembler_ = {};
  entries_ = {};
}

void RecentTexts::keep(Timestamp now, const vehicle::Alert& alert) {
  std::ranges::rotate(entries_, entries_.begin() + 1);
  entries_.back() = {now, alert.text};
}

Text<159> RecentTexts::since(Timestamp time) const {
  std::array<char, Text<159>::capacity> joined{};
  std::size_t size = 0;
  const auto append = [&](std::string_view more) {
    const auto part = more.substr(0, joined.size() - size);
    std::ranges::copy(part, joined.begin() + static_cast<std::ptrdiff_t>(size));
    size += part.size();
  };
  for (const auto& entry : entries_) {
    if (entry.text.empty() || entry.time < time) continue;
    if (size > 0) append("; ");
    append(entry.text.view());
  }
  return Text<159>{std::string_view{joined.data(), size}};
}

}  // namespace ponte::autopilot
