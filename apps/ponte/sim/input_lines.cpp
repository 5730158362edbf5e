#include "sim/input_lines.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>

namespace ponte::app {
namespace {

constexpr Duration interval = std::chrono::milliseconds{100};
constexpr std::size_t longest_line = 4096;

}  // namespace

InputLines::InputLines(transport::Loop& loop, std::function<void(std::string_view line)> on_line)
    : on_line_{std::move(on_line)}, timer_{loop, [this](Timestamp now) { look(now); }} {
  timer_.set(loop.now());
}

void InputLines::look(Timestamp now) {
  std::array<char, 512> buffer{};
  for (pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0}; poll(&input, 1, 0) == 1;) {
    const auto size = read(STDIN_FILENO, buffer.data(), buffer.size());
    if (size <= 0) return;  // it has ended, and so does the looking
    unfinished_.append(buffer.data(), static_cast<std::size_t>(size));
    for (auto end = unfinished_.find('\n'); end != std::string::npos; end = unfinished_.find('\n')) {
      if (end > 0) on_line_(std::string_view{unfinished_}.substr(0, end));
      unfinished_.erase(0, end + 1);
    }
    if (unfinished_.size() > longest_line) unfinished_.clear();
  }
  timer_.set(now + interval);
}

}  // namespace ponte::app
