#include "common/number_list.hpp"

#include <charconv>
#include <cmath>

namespace ponte::app {

std::optional<std::vector<double>> numbers_in(std::string_view text, std::size_t least, std::size_t most) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  while (numbers.size() < most) {
    double number{};
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
    at = next;
    if (at == end) break;
    if (*at != ',') return std::nullopt;
    ++at;
  }
  if (at != end || text.ends_with(',') || numbers.size() < least) return std::nullopt;
  return numbers;
}

}  // namespace ponte::app
