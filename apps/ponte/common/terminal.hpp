#pragma once

#include <termios.h>

#include <optional>
#include <string_view>

namespace ponte::app {

/// The terminal as a window that is drawn anew each time, with keys that need no Enter. What was on it comes back at
/// the end. Throws `Failure` when stdin or stdout is none.
class Terminal {
 public:
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// Whether stdin and stdout are a terminal.
  [[nodiscard]] static bool is_there();
  /// Replaces what is shown, as much of it as there is room for. Lines end with '\n' and are ASCII.
  void draw(std::string_view lines);
  /// The next key that was pressed; nothing when there is none.
  [[nodiscard]] std::optional<char> key();

 private:
  termios before_{};
};

}  // namespace ponte::app
