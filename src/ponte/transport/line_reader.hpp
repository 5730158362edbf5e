#pragma once

#include "ponte/transport/file_descriptor.hpp"
#include "ponte/transport/loop.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>

namespace ponte::transport {

/// Standard input, to be read without waiting. A terminal is opened anew, as reading it so would change it for the
/// shell, too. Holds nothing if there is no standard input.
[[nodiscard]] FileDescriptor standard_input();

/// Reads lines of text on the loop's thread, from a terminal, a pipe, a socket or a file.
class LineReader {
 public:
  static constexpr std::size_t line_limit = 4096;  ///< bytes, with the end of the line

  /// `on_line` is given each line without its end, also a last one that has none; `on_end`, one line for people, when
  /// nothing more will be read: there is no more, a line is longer than the limit, or reading failed. Both may destroy
  /// the reader, and neither is called within this constructor. The loop outlives it.
  LineReader(Loop& loop, FileDescriptor input, std::function<void(std::string_view line)> on_line,
             std::function<void(std::string_view reason)> on_end);
  /// Ends the calls.
  ~LineReader();
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

 private:
  struct State;

  std::shared_ptr<State> state_;
};

}  // namespace ponte::transport
