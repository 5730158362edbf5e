#include "ponte/sim/speaker.hpp"

#include "ponte/mavlink/autopilots/enums.hpp"
#include "ponte/mavlink/autopilots/statustext.hpp"
#include "ponte/mavlink/v09/statustext.hpp"

namespace ponte::sim {

namespace messages = mavlink::autopilots;

/// ArduPilot numbers the texts that it has to cut, PX4 all of them. 0 means that there is one piece only.
std::uint16_t TextNumbers::next(bool has_pieces) {
  if (!has_pieces && personality_ == Personality::ardupilot) return 0;
  if (++last_ == 0) ++last_;
  return last_;
}

void Speaker::say(std::uint8_t severity, std::string_view text) {
  if (version_ == mavlink::Version::v0_9) {
    const bool is_critical = severity <= messages::MAV_SEVERITY_CRITICAL;
    send(mavlink::v09::Statustext{.severity = static_cast<std::uint8_t>(is_critical ? 255 : 0), .text = text});
    return;
  }
  messages::Statustext piece{.severity = severity};
  constexpr std::size_t capacity = decltype(piece.text)::capacity;
  piece.id = numbers_.next(text.size() > capacity);
  do {
    piece.text = text.substr(0, capacity);
    text.remove_prefix(std::min(capacity, text.size()));
    send(piece);
    ++piece.chunk_seq;
  } while (!text.empty());
}

}  // namespace ponte::sim
