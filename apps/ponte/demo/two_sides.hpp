#pragma once

#include "ponte/core/time.hpp"
#include "ponte/dli/profile.hpp"
#include "ponte/vsm/crossing.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace ponte::app {

inline constexpr std::array<const char*, 3> angle_names{"roll", "pitch", "yaw"};

/// One attitude in both languages: as the vehicle said it, and as a ground station heard it.
struct AttitudePair {
  std::vector<std::byte> frame;      ///< ATTITUDE, whole
  std::array<float, 3> radians{};    ///< roll, pitch, yaw
  std::vector<std::byte> message{};  ///< #4000, whole; empty while conversion is off
  std::array<std::optional<std::int16_t>, 3> bam{};
  Duration decoded{}, translated{}, sent{};  ///< since the last byte was received
};

/// What was seen of both sides.
struct DemoCounts {
  std::uint64_t frames{};             ///< of any message
  std::uint64_t attitudes{};          ///< among them
  std::uint64_t messages{};           ///< of the DLI, heard by the station
  std::uint64_t compared{};           ///< attitudes that were heard on both sides
  std::uint64_t different{};          ///< among them, by more than one unit
  std::uint64_t not_heard{};          ///< #4000 that were sent and did not arrive
  int largest_difference{};           ///< in units of the binary angle
  Duration delay_sum{}, delay_max{};  ///< from decoded to sent, of the compared ones
};

/// Puts the attitudes that the VSM translates beside what a ground station hears on its own socket, and compares them
/// by a rule of its own: a binary angle of two bytes is the angle over pi, times 2^15.
class TwoSides {
 public:
  explicit TwoSides(const dli::Profile& profile) : profile_{profile} {}

  void on_crossing(const vsm::Crossing& crossing);
  /// What the station hears.
  void on_datagram(Bytes datagram);

  /// The newest attitude that both sides have; while nothing is converted, the newest of the left side.
  [[nodiscard]] const std::optional<AttitudePair>& shown() const { return shown_; }
  [[nodiscard]] const DemoCounts& counts() const { return counts_; }
  [[nodiscard]] const dli::Profile& profile() const { return profile_; }

 private:
  static constexpr std::size_t waiting_limit = 256;

  void compare(AttitudePair& pair, const dli::WrapperView& message);

  dli::Profile profile_;
  std::deque<AttitudePair> waiting_;  ///< sent, and not heard yet
  std::optional<AttitudePair> shown_;
  DemoCounts counts_;
};

}  // namespace ponte::app
