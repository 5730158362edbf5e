#pragma once

#include "ponte/core/result.hpp"
#include "ponte/dli/message_info.hpp"
#include "ponte/dli/profile.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace ponte::dli {

/// What keeps a text from being a profile, for a message such as "line 7, override.scale: expected a number above 0".
struct ProfileFileError {
  std::uint32_t line;       ///< from 1
  std::string key;          ///< empty when the text is not TOML at all
  std::string expectation;  ///< completes "expected ..."

  friend bool operator==(const ProfileFileError&, const ProfileFileError&) = default;
};

/// Reads a profile written in TOML. Every key has a default, and unknown keys are refused:
///
///     edition = "3"                      # or "A"
///     idd_version = 30                   # 0 to 127; the edition's own by default
///     checksum = 2                       # bytes: 0, 2 or 4
///     accept_unassigned_checksum = false # take messages with checksum code 11, without examining them
///     [[override]]
///     message = 4000                     # one of `catalogue`
///     field = "turn_rate"                # key or number of an integer field that is no BAM
///     scale = 0.0005
///     [[override]]
///     message = 3007
///     presence_bytes = 4                 # 1 to 8
///
/// An override has a field with its scale, or the width of the presence vector, or both.
[[nodiscard]] Result<Profile, ProfileFileError> parse_profile(std::string_view text, const Catalogue& catalogue);

}  // namespace ponte::dli
