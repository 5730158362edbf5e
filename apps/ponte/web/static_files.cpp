#include "web/static_files.hpp"

#include "common/failure.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <iterator>
#include <system_error>

namespace ponte::app {
namespace {

namespace fs = std::filesystem;

std::string_view type_of(const fs::path& file) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> types{{
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".svg", "image/svg+xml"},
      {".json", "application/json"},
      {".webmanifest", "application/manifest+json"},
      {".png", "image/png"},
      {".ico", "image/x-icon"},
      {".woff2", "font/woff2"},
  }};
  for (const auto& [extension, type] : types)
    if (file.extension() == extension) return type;
  return "application/octet-stream";
}

std::string content_of(const fs::path& file) {
  std::ifstream stream{file, std::ios::binary};
  std::string content{std::istreambuf_iterator<char>{stream}, {}};
  if (!stream.good() && !stream.eof()) throw Failure{fmt::format("{}: cannot be read", file.string())};
  return content;
}

}  // namespace

StaticFiles::StaticFiles(const fs::path& root) try {
  std::uintmax_t size = 0;
  for (const auto& entry : fs::recursive_directory_iterator{root}) {
    if (!entry.is_regular_file()) continue;
    size += entry.file_size();
    if (size > size_max)
      throw Failure{fmt::format("{}: more than {} bytes; expected the folder of the built page", root.string(),
                                size_max)};
    files_["/" + fs::relative(entry.path(), root).generic_string()] = shared_text(content_of(entry.path()));
  }
  if (!files_.contains("/index.html"))
    throw Failure{fmt::format("{}: has no index.html; expected the folder of the built page", root.string())};
} catch (const fs::filesystem_error& error) {
  throw Failure{fmt::format("{}: {}", root.string(), error.code().message())};
}

HttpResponse StaticFiles::get(const HttpRequest& request) const {
  const auto path = request.path == "/" ? std::string{"/index.html"} : request.path;
  const auto file = files_.find(path);
  if (file == files_.end()) return problem(404, "not_found", "there is nothing here");
  HttpResponse response{.type = std::string{type_of(path)}, .body = file->second};
  const bool has_hash = path.starts_with("/assets/");
  response.headers.emplace_back("Cache-Control", has_hash ? "public, max-age=31536000, immutable" : "no-cache");
  if (const auto zipped = files_.find(path + ".gz"); zipped != files_.end()) {
    response.headers.emplace_back("Vary", "Accept-Encoding");
    if (request.accepts_gzip) {
      response.body = zipped->second;
      response.headers.emplace_back("Content-Encoding", "gzip");
    }
  }
  return response;
}

fs::path find_web_root() {
  std::error_code error;
  const auto program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const auto prefix = program.parent_path().parent_path();
  for (const auto& folder : {prefix / "share/ponte/web", prefix.parent_path() / "web/bridge"})
    if (fs::exists(folder / "index.html", error)) return folder;
  return {};
}

}  // namespace ponte::app
