#include "web/gzip.hpp"

#include "ponte/core/assert.hpp"

#define ZLIB_CONST  // what is read is constant
#include <zlib.h>

namespace ponte::app {

std::string gzip(std::string_view text) {
  z_stream stream{};
  constexpr int gzip_window = MAX_WBITS + 16;
  constexpr int memory_level = 8;
  auto status = ::deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_window, memory_level, Z_DEFAULT_STRATEGY);
  PONTE_ASSERT(status == Z_OK);
  std::string zipped(::deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<const Bytef*>(text.data());
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(zipped.data());
  stream.avail_out = static_cast<uInt>(zipped.size());
  status = ::deflate(&stream, Z_FINISH);
  PONTE_ASSERT(status == Z_STREAM_END);
  zipped.resize(stream.total_out);
  ::deflateEnd(&stream);
  return zipped;
}

}  // namespace ponte::app
