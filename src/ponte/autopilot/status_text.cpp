#include "ponte/autopilot/status_text.hpp"

#include <algorithm>
#include <cctype>

namespace ponte::autopilot {
namespace {

using enum vehicle::Subsystem;

constexpr std::array rows{
    KeywordRow{"ekf", navigation},
    KeywordRow{"ekf2", navigation},
    KeywordRow{"ekf3", navigation},
    KeywordRow{"ahrs", navigation},
    KeywordRow{"gps", navigation},
    KeywordRow{"compass", navigation},
    KeywordRow{"gyro", navigation},
    KeywordRow{"gyros", navigation},
    KeywordRow{"accels", navigation},
    KeywordRow{"position", navigation},
    KeywordRow{"battery", propulsion_energy},
    KeywordRow{"fuel", propulsion_energy},
    KeywordRow{"motor", engine},
    KeywordRow{"motors", engine},
    KeywordRow{"esc", engine},
    KeywordRow{"engine", engine},
    KeywordRow{"rc", comms},
    KeywordRow{"radio", comms},
    KeywordRow{"link", comms},
    KeywordRow{"gcs", comms},
    KeywordRow{"gimbal", payload},
    KeywordRow{"mount", payload},
    KeywordRow{"camera", payload},
    KeywordRow{"parachute", recovery},
};

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// True when `word` (lower case) stands in `text` with no letter or digit beside it.
bool has_word(std::string_view text, std::string_view word) {
  const auto same = [](char a, char b) { return lower(a) == b; };
  for (auto from = text.begin();;) {
    const auto found = std::search(from, text.end(), word.begin(), word.end(), same);
    if (found == text.end()) return false;
    const auto end = found + static_cast<std::ptrdiff_t>(word.size());
    if ((found == text.begin() || !is_word(found[-1])) && (end == text.end() || !is_word(*end))) return true;
    from = found + 1;
  }
}

/// Alert texts are printable ASCII; the tabs with which PX4 marks some texts go.
bool is_printable(char c) { return c >= ' ' && c <= '~'; }

}  // namespace

std::optional<vehicle::Condition> severity_of(std::uint8_t mav_severity) {
  using enum vehicle::Condition;
  static constexpr std::array conditions{emergency, emergency, warning, warning, caution, nominal, nominal};
  if (mav_severity >= conditions.size()) return std::nullopt;
  return conditions[mav_severity];
}

std::span<const KeywordRow> keyword_rows() { return rows; }

vehicle::Subsystem subsystem_of(std::string_view text) {
  const auto found = std::ranges::find_if(rows, [&](const KeywordRow& row) { return has_word(text, row.keyword); });
  return found == rows.end() ? vsm : found->subsystem;
}

void StatusTextAssembler::begin(std::uint8_t severity, std::uint16_t id, std::uint8_t chunk) {
  pending_ = true;
  severity_ = severity;
  id_ = id;
  next_chunk_ = chunk;
  size_ = 0;
}

void StatusTextAssembler::append(Timestamp now, std::string_view text) {
  last_ = now;
  ++next_chunk_;
  for (const char c : text)
    if (is_printable(c) && size_ < text_.size()) text_[size_++] = c;
}

std::optional<vehicle::Alert> StatusTextAssembler::take() {
  if (!pending_) return std::nullopt;
  pending_ = false;
  const std::string_view text{text_.data(), size_};
  const auto severity = severity_of(severity_);
  if (!severity || text.empty()) return std::nullopt;
  return vehicle::Alert{*severity, subsystem_of(text), text};
}

}  // namespace ponte::autopilot
