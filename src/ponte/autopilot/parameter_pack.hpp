#pragma once

#include "ponte/autopilot/parameter.hpp"
#include "ponte/core/bytes.hpp"
#include "ponte/core/result.hpp"

#include <string_view>
#include <vector>

/// `@PARAM/param.pck`, in which ArduPilot gives all its parameters through MAVFTP: a header of three numbers of 16 bits
/// (magic, how many follow, how many there are), then of each parameter its type, the length of what its name shares
/// with the one before and of the rest, that rest, and the value.
namespace ponte::autopilot {

struct PackError {
  std::size_t offset{};     ///< of the byte that is wrong
  std::string_view what{};  ///< e.g. "the type is 9"
  friend bool operator==(const PackError&, const PackError&) = default;
};

/// The parameters in the file, which is whole. Default values that it may tell too are skipped.
[[nodiscard]] Result<std::vector<Parameter>, PackError> unpack_parameters(Bytes file);

}  // namespace ponte::autopilot
