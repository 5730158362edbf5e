#pragma once

#include "ponte/transport/loop.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace ponte::app {

/// Hands over each line of standard input, looking for them several times a second, until it ends.
class InputLines {
 public:
  InputLines(transport::Loop& loop, std::function<void(std::string_view line)> on_line);

 private:
  void look(Timestamp now);

  std::function<void(std::string_view line)> on_line_;
  std::string unfinished_;
  transport::Timer timer_;
};

}  // namespace ponte::app
