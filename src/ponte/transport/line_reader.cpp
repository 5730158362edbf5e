#include "ponte/transport/line_reader.hpp"

#include "ponte/transport/asio.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <string>

namespace ponte::transport {

/// Shared with the coroutine, which may come to its end after the reader has gone.
struct LineReader::State {
  State(Loop& loop, FileDescriptor descriptor, std::function<void(std::string_view)> its_on_line,
        std::function<void(std::string_view)> its_on_end)
      : input{loop.context(), descriptor.release()}, on_line{std::move(its_on_line)}, on_end{std::move(its_on_end)} {}

  static asio::awaitable<void> run(std::shared_ptr<State> self) {
    std::string text;
    error_code error;
    while (!self->is_over && !error) {
      auto buffer = asio::dynamic_buffer(text, line_limit);
      auto token = asio::redirect_error(asio::use_awaitable, error);
      const auto size = co_await asio::async_read_until(self->input, buffer, '\n', token);
      if (size > 0 && !self->is_over) {
        const auto line = text.substr(0, size - 1);
        text.erase(0, size);
        self->on_line(line);
      }
    }
    if (!self->is_over && error == asio::error::eof && !text.empty()) self->on_line(text);
    if (self->is_over) co_return;
    if (error == asio::error::eof)
      self->on_end("there is no more");
    else if (error == asio::error::not_found)
      self->on_end("a line is longer than " + std::to_string(line_limit) + " bytes");
    else
      self->on_end(error.message());
  }

  asio::posix::stream_descriptor input;
  std::function<void(std::string_view)> on_line;
  std::function<void(std::string_view)> on_end;
  bool is_over{};
};

FileDescriptor standard_input() {
  return FileDescriptor{::isatty(STDIN_FILENO) == 1 ? ::open("/dev/stdin", O_RDONLY | O_NOCTTY | O_CLOEXEC)
                                                    : ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)};
}

LineReader::LineReader(Loop& loop, FileDescriptor input, std::function<void(std::string_view)> on_line,
                       std::function<void(std::string_view)> on_end)
    : state_{std::make_shared<State>(loop, std::move(input), std::move(on_line), std::move(on_end))} {
  spawn(loop, State::run(state_));
}

LineReader::~LineReader() {
  state_->is_over = true;
  error_code ignored;
  state_->input.close(ignored);
}

}  // namespace ponte::transport
