#include "common/load_file.hpp"

#include "common/failure.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <system_error>

namespace ponte::app {
namespace {

std::vector<std::byte> read_all(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw Failure{fmt::format("{}: is a folder; a file was expected", path.string())};
  std::ifstream file{path, std::ios::binary | std::ios::ate};
  if (!file) throw Failure{fmt::format("{}: cannot be opened: {}", path.string(), std::strerror(errno))};
  const auto size = static_cast<std::streamoff>(file.tellg());
  std::vector<std::byte> bytes(static_cast<std::size_t>(std::max<std::streamoff>(size, 0)));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw Failure{fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno))};
  return bytes;
}

/// The state of zlib, given back at the end.
class Inflater {
 public:
  Inflater() {
    constexpr int gzip_only = 16 + MAX_WBITS;
    if (inflateInit2(&stream, gzip_only) != Z_OK) throw Failure{"out of memory"};
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream); }

  z_stream stream{};
};

LoadedFile unpack(std::vector<std::byte> packed) {
  LoadedFile result;
  Inflater inflater;
  auto& stream = inflater.stream;
  std::array<std::byte, 1U << 16U> chunk{};
  std::size_t fed = 0;
  const auto damage = [&](std::string_view why) {
    result.damage = fmt::format("offset {} of the gzip file: {}", fed - stream.avail_in, why);
  };
  while (true) {
    if (stream.avail_in == 0) {
      const auto more = std::min<std::size_t>(packed.size() - fed, std::numeric_limits<uInt>::max());
      stream.next_in = reinterpret_cast<Bytef*>(packed.data() + fed);
      stream.avail_in = static_cast<uInt>(more);
      fed += more;
    }
    stream.next_out = reinterpret_cast<Bytef*>(chunk.data());
    stream.avail_out = static_cast<uInt>(chunk.size());
    const int status = inflate(&stream, Z_NO_FLUSH);
    const auto count = static_cast<std::ptrdiff_t>(chunk.size() - stream.avail_out);
    result.bytes.insert(result.bytes.end(), chunk.begin(), chunk.begin() + count);
    if (status == Z_STREAM_END) {
      if (stream.avail_in == 0 && fed == packed.size()) return result;
      if (inflateReset(&stream) != Z_OK) break;  // another member follows
    } else if (status == Z_BUF_ERROR ||
               (status == Z_OK && stream.avail_in == 0 && fed == packed.size() && count == 0)) {
      damage("it ends too early");
      break;
    } else if (status != Z_OK) {
      damage(stream.msg != nullptr ? stream.msg : "not gzip data");
      break;
    }
  }
  return result;
}

bool is_gzip(const std::vector<std::byte>& bytes) {
  return bytes.size() >= 2 && bytes[0] == std::byte{0x1F} && bytes[1] == std::byte{0x8B};
}

}  // namespace

LoadedFile load_file(const std::filesystem::path& path) {
  auto bytes = read_all(path);
  if (is_gzip(bytes)) return unpack(std::move(bytes));
  return {std::move(bytes), {}};
}

void save_file(const std::filesystem::path& path, Bytes bytes) {
  std::ofstream file{path, std::ios::binary};
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw Failure{fmt::format("{}: cannot be written: {}", path.string(), std::strerror(errno))};
}

}  // namespace ponte::app
