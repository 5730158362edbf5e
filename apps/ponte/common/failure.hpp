#pragma once

#include <stdexcept>

namespace ponte::app {

/// Why the job cannot be done. It travels to `main`, which prints it once and ends with status 1.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A command line that cannot be meant: status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace ponte::app
