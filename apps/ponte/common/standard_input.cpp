#include "common/standard_input.hpp"

#include "common/failure.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace ponte::app {

transport::FileDescriptor open_standard_input(std::string_view option) {
  auto input = transport::standard_input();
  if (!input) throw Failure{fmt::format("{}: standard input cannot be read: {}", option, std::strerror(errno))};
  return input;
}

}  // namespace ponte::app
