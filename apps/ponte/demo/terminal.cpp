#include "demo/terminal.hpp"

#include "common/failure.hpp"

#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace ponte::app {

Terminal::Terminal() {
  if (isatty(STDIN_FILENO) == 0 || isatty(STDOUT_FILENO) == 0 || tcgetattr(STDIN_FILENO, &before_) != 0)
    throw Failure{"ponte demo: this is no terminal; --headless runs without one"};
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
  std::string text = "\x1b[H";
  for (const char c : lines) {
    if (c == '\n') text += "\x1b[K";  // what an older, longer line left
    text += c;
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
