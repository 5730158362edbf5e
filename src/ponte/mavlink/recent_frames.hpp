#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/time.hpp"

#include <cstdint>
#include <vector>

namespace ponte::mavlink {

/// Remembers which frames came lately, and on which link, by a hash of all their bytes. As the sequence number and, if
/// there is one, the signature are among them, a sender hardly makes the same frame twice within the window.
class RecentFrames {
 public:
  static constexpr Duration window = std::chrono::seconds{2};

  /// The seed should be one that a forger cannot know, so that no frame is made that looks like another.
  explicit RecentFrames(std::uint64_t seed) : seed_{seed}, entries_(entry_count) {}

  enum class Arrival : std::uint8_t {
    first,      ///< or the first within the window
    again,      ///< the very same frame came on this link within the window
    elsewhere,  ///< the very same frame came on another link within the window
  };
  /// A frame comes on a link. That it did is remembered, unless it came elsewhere.
  [[nodiscard]] Arrival arrive(Timestamp now, std::uint16_t link, Bytes frame);

 private:
  static constexpr std::size_t entry_count = 8192;  ///< a power of 2
  struct Entry {
    std::uint64_t hash{};  ///< 0: none
    Timestamp time{};
    std::uint16_t link{};
  };

  std::uint64_t seed_;
  std::vector<Entry> entries_;  ///< the place is the hash's: a new one takes it from what was there
};

}  // namespace ponte::mavlink
