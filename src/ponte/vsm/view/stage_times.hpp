#pragma once

#include "ponte/core/json_text.hpp"
#include "ponte/core/time.hpp"
#include "ponte/vsm/crossing.hpp"

#include <array>
#include <cstdint>

namespace ponte::vsm::view {

/// How a duration was distributed, in memory that never grows.
class Histogram {
 public:
  /// Upper bounds of the buckets that are shown, in ns: 1, 2 and 5 of each power of ten from a microsecond to 5 s.
  static constexpr auto bounds_ns = [] {
    std::array<std::uint64_t, 21> bounds{};
    std::uint64_t decade = 1000;
    for (std::size_t i = 0; i < bounds.size(); i += 3, decade *= 10) {
      bounds[i] = decade;
      bounds[i + 1] = 2 * decade;
      bounds[i + 2] = 5 * decade;
    }
    return bounds;
  }();

  /// A negative duration counts as 0.
  void add(Duration duration);
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::uint64_t max_ns() const { return max_ns_; }
  [[nodiscard]] std::uint64_t sum_ns() const { return sum_ns_; }
  /// The shortest time that `share` (0 to 1) of the durations did not exceed, at most 7 % too long; 0 without any.
  [[nodiscard]] std::uint64_t percentile_ns(double share) const;
  /// One more than bounds: the last is for what is longer than the last bound.
  [[nodiscard]] const std::array<std::uint64_t, bounds_ns.size() + 1>& buckets() const { return buckets_; }

 private:
  // 16 bins for each power of two, of equal width within it, for the percentiles.
  static constexpr unsigned bin_bits = 4;

  static std::size_t bin_of(std::uint64_t ns);
  static std::uint64_t last_of_bin(std::size_t bin);

  std::uint64_t count_{};
  std::uint64_t max_ns_{};
  std::uint64_t sum_ns_{};
  std::array<std::uint64_t, bounds_ns.size() + 1> buckets_{};
  std::array<std::uint64_t, 64U << bin_bits> bins_{};
};

/// How long the stages of translated frames took.
struct StageTimes {
  Histogram decode;     ///< received to decoded
  Histogram translate;  ///< decoded to translated
  Histogram send;       ///< translated to sent
  Histogram total;      ///< received to sent

  void add(const Crossing& crossing);
};

/// Appends the object `{"kind":"timing", ...}` of web/contract/messages.schema.json.
void append_timing(JsonText& json, const StageTimes& times);

}  // namespace ponte::vsm::view
