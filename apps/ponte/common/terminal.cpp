#include "common/terminal.hpp"

#include "common/failure.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace ponte::app {

bool Terminal::is_there() { return isatty(STDIN_FILENO) == 1 && isatty(STDOUT_FILENO) == 1; }

Terminal::Terminal() {
  if (!is_there() || tcgetattr(STDIN_FILENO, &before_) != 0) throw Failure{"this is no terminal"};
  auto raw = before_;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  tcsetattr(STDIN_FILENO, TCSANOW, &raw);
  std::fputs("\x1b[?1049h\x1b[?25l", stdout);  // another screen, no cursor
}

Terminal::~Terminal() {
  std::fputs("\x1b[?25h\x1b[?1049l", stdout);
  std::fflush(stdout);
  tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

void Terminal::draw(std::string_view lines) {
  winsize window{};
  const bool is_known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) == 0 && window.ws_row > 0;
  const std::size_t rows = is_known ? window.ws_row : 24;
  const std::size_t columns = is_known ? window.ws_col : 80;
  std::string text = "\x1b[H";
  for (std::size_t row = 0; row < rows && !lines.empty(); ++row) {
    const auto end = lines.find('\n');
    if (row > 0) text += "\r\n";
    text += lines.substr(0, std::min(end, columns));
    text += "\x1b[K";  // what an older, longer line left
    lines.remove_prefix(end == std::string_view::npos ? lines.size() : end + 1);
  }
  text += "\x1b[J";
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

std::optional<char> Terminal::key() {
  pollfd stdin_poll{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
  char c{};
  if (poll(&stdin_poll, 1, 0) != 1 || read(STDIN_FILENO, &c, 1) != 1) return std::nullopt;
  return c;
}

}  // namespace ponte::app
