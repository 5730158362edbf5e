#pragma once

#include "web/http_message.hpp"

#include <filesystem>
#include <map>
#include <string>

namespace ponte::app {

/// The files of the page, read into memory at the start: what is not there then cannot be asked for.
class StaticFiles {
 public:
  static constexpr std::uintmax_t size_max = 32'000'000;  ///< of all together

  StaticFiles() = default;
  /// Reads a folder, which has an index.html. Throws `Failure`.
  explicit StaticFiles(const std::filesystem::path& root);

  [[nodiscard]] bool empty() const { return files_.empty(); }
  /// The answer to GET; `/` is `/index.html`.
  [[nodiscard]] HttpResponse get(const HttpRequest& request) const;

 private:
  std::map<std::string, vsm::view::SharedText, std::less<>> files_;  ///< by path, with a slash before it
};

/// Where the page is: beside an installed program, or built in its source tree. Nothing when it is at neither place.
[[nodiscard]] std::filesystem::path find_web_root();

}  // namespace ponte::app
