#pragma once

#include "ponte/core/bytes.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ponte::app {

/// A file in memory, un-gzipped if it was gzipped.
struct LoadedFile {
  std::vector<std::byte> bytes;
  /// Why there is not more of it, e.g. "offset 1234 of the gzip file: ..."; empty when it is whole.
  std::string damage;
};

/// Reads a file whole. A damaged gzip file gives what could be unpacked. Throws `Failure` if it cannot be read at all.
[[nodiscard]] LoadedFile load_file(const std::filesystem::path& path);

/// Writes a file whole. Throws `Failure`.
void save_file(const std::filesystem::path& path, Bytes bytes);

}  // namespace ponte::app
