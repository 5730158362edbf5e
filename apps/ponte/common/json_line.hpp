#pragma once

#include "ponte/core/json_text.hpp"

#include <cstdio>

namespace ponte::app {

/// Writes the line to stdout, and clears it for the next.
inline void print_line(JsonText& json) {
  std::fwrite(json.text().data(), 1, json.text().size(), stdout);
  std::fputc('\n', stdout);
  json.clear();
}

}  // namespace ponte::app
