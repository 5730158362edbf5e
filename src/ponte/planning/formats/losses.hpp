#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ponte::planning {

/// Collects what a format cannot say, and tells it in a line for each kind.
class Losses {
 public:
  /// `what` of the `kind` number `number`, from 1, e.g. "priority" of "point" 3.
  void add(std::string what, std::string kind, std::size_t number);
  /// A whole clause.
  void add(std::string clause) { clauses_.push_back(std::move(clause)); }
  /// E.g. "priority: point 3", "dwell: 12 points, the first is point 1".
  [[nodiscard]] std::vector<std::string> told() const;

 private:
  struct Count {
    std::size_t first{};
    std::size_t count{};
  };
  std::map<std::pair<std::string, std::string>, Count> counts_;
  std::vector<std::string> clauses_;
};

}  // namespace ponte::planning
