#pragma once

#include "ponte/core/assert.hpp"
#include "ponte/core/time.hpp"

#include <cstdint>
#include <optional>

namespace ponte::vehicle {

/// Counts the changes of a `State`, so that a reader can tell what is newer than its last look.
using Revision = std::uint64_t;

/// How good a source is where several tell the same thing: 0 is the best.
using SourceRank = std::uint8_t;

/// A worse source is listened to when the better one has been silent for this long.
inline constexpr std::chrono::seconds better_source_silence{2};

/// When something is learnt.
struct Moment {
  WallTime at{};        ///< true at the source then; the clocks of sources need not agree
  Timestamp heard{};    ///< told to us then
  Revision revision{};  ///< of the `State` that learns it
};

/// One thing that is known of a vehicle, or not: value, the time it was true at the source, and when it changed here.
template <class T>
class Fact {
 public:
  using value_type = T;

  [[nodiscard]] bool known() const { return value_.has_value(); }
  explicit operator bool() const { return known(); }
  /// Only to be called when known.
  [[nodiscard]] const T& value() const {
    PONTE_ASSERT(value_.has_value());
    return *value_;
  }
  [[nodiscard]] std::optional<T> get() const { return value_; }
  [[nodiscard]] WallTime at() const { return at_; }
  /// True when it is known and was learnt after `revision`, be the value another or the same.
  [[nodiscard]] bool newer_than(Revision revision) const { return known() && revision_ > revision; }

  /// True when it is known and has another value than at `revision`.
  [[nodiscard]] bool changed_since(Revision revision) const { return known() && changed_ > revision; }

  /// Takes the value unless a better source was heard less than `better_source_silence` before. False: not taken.
  bool learn(const T& value, const Moment& moment, SourceRank rank = 0) {
    if (known() && rank > rank_ && moment.heard - heard_ < better_source_silence) return false;
    if (value_ != value) changed_ = moment.revision;
    value_ = value;
    at_ = moment.at;
    heard_ = moment.heard;
    revision_ = moment.revision;
    rank_ = rank;
    return true;
  }
  void forget() { value_.reset(); }

 private:
  std::optional<T> value_;
  WallTime at_{};
  Timestamp heard_{};
  Revision revision_{};
  Revision changed_{};
  SourceRank rank_{};
};

}  // namespace ponte::vehicle
