#include "ponte/sim/radio.hpp"

#include "ponte/mavlink/autopilots/radio_status.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace ponte::sim {
namespace {

namespace messages = mavlink::autopilots;

constexpr double noise_dbm = -107;

/// The unit of SiK radios: 1.9 for each dB above -127 dBm.
std::uint8_t sik_strength(double dbm) {
  return static_cast<std::uint8_t>(std::clamp(std::round((dbm + 127) * 1.9), 0.0, 254.0));
}

/// In free space, of 100 mW at 915 MHz.
double strength_dbm(Metres distance) {
  constexpr double sent_dbm = 20;
  constexpr double loss_at_one_metre = 31.7;
  return std::max(noise_dbm, sent_dbm - loss_at_one_metre - 20 * std::log10(std::max(distance.value, 1.0)));
}

}  // namespace

void Radio::report(Metres distance, bool is_in_reach, Outbox<mavlink::FrameBuffer>& out) {
  if (sender_.version() == mavlink::Version::v0_9) return;
  const auto noise = sik_strength(noise_dbm);
  const auto heard = is_in_reach ? sik_strength(strength_dbm(distance)) : noise;
  sender_.send(messages::RadioStatus{.rssi = heard,
                                     .remrssi = is_in_reach ? heard : std::uint8_t{},
                                     .txbuf = 100,
                                     .noise = noise,
                                     .remnoise = noise},
               out);
}

}  // namespace ponte::sim
