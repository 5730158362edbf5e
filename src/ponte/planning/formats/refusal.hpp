#pragma once

#include "ponte/planning/formats/mission_file.hpp"

#include <string>
#include <utility>

namespace ponte::planning {

/// Throws a `FormatError`. It never leaves a reader, whose outermost function returns it.
[[noreturn]] inline void refuse(Where where, std::string what, std::string expectation) {
  throw FormatError{where, std::move(what), std::move(expectation)};
}

}  // namespace ponte::planning
