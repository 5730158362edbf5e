#include "ponte/planning/formats/losses.hpp"

#include <fmt/format.h>

namespace ponte::planning {

void Losses::add(std::string what, std::string kind, std::size_t number) {
  auto& count = counts_[{std::move(what), std::move(kind)}];
  if (count.count++ == 0) count.first = number;
}

std::vector<std::string> Losses::told() const {
  auto lines = clauses_;
  for (const auto& [what_and_kind, count] : counts_) {
    const auto& [what, kind] = what_and_kind;
    if (count.count == 1)
      lines.push_back(fmt::format("{}: {} {}", what, kind, count.first));
    else
      lines.push_back(fmt::format("{}: {} {}s, the first is {} {}", what, count.count, kind, kind, count.first));
  }
  return lines;
}

}  // namespace ponte::planning
