#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/time.hpp"

#include <string_view>

namespace ponte::world {

/// Everything that happens in a world, as lines on stdout that can be read, if somebody wants to.
class Timeline {
 public:
  explicit Timeline(bool wanted) : wanted_{wanted} {}
  /// Wanted if the environment says PONTE_TIMELINE=1.
  [[nodiscard]] static Timeline chosen();

  [[nodiscard]] bool is_wanted() const { return wanted_; }
  /// The messages in the piece are named, with their fields.
  void sent(Timestamp now, std::string_view from, std::string_view to, Bytes piece, std::string_view fate) const;
  void happened(Timestamp now, std::string_view whom, std::string_view what) const;

 private:
  bool wanted_;
};

}  // namespace ponte::world
