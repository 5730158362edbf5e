#include "ponte/planning/formats/csv_rows.hpp"

#include "ponte/planning/formats/text.hpp"

#include <algorithm>
#include <utility>

namespace ponte::planning {
namespace {

/// Takes one cell after another from the text.
class CellReader {
 public:
  CellReader(std::string_view text, char separator) : rest_{text}, separator_{separator} {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] std::size_t line() const { return line_; }
  /// True when the cell taken last was the last one of its row.
  [[nodiscard]] bool row_ended() const { return row_ended_; }

  Result<std::string, FormatError> take() {
    std::string cell;
    if (rest_.starts_with('"')) {
      const auto first_line = line_;
      if (!take_quoted(cell)) return fail(FormatError{at_line(first_line), "a quote is not closed", "a closing quote"});
    }
    const auto length = std::min(rest_.find_first_of(std::string{separator_} + "\r\n"), rest_.size());
    cell += rest_.substr(0, length);
    rest_.remove_prefix(length);
    take_separator();
    return cell;
  }

 private:
  bool take_quoted(std::string& cell) {
    rest_.remove_prefix(1);
    while (true) {
      const auto quote = rest_.find('"');
      if (quote == std::string_view::npos) return false;
      cell += rest_.substr(0, quote);
      line_ += static_cast<std::size_t>(std::ranges::count(rest_.substr(0, quote), '\n'));
      rest_.remove_prefix(quote + 1);
      if (!rest_.starts_with('"')) return true;
      cell += '"';
      rest_.remove_prefix(1);
    }
  }

  void take_separator() {
    row_ended_ = !rest_.starts_with(separator_);
    if (!row_ended_) {
      rest_.remove_prefix(1);
      return;
    }
    ++line_;
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(rest_.size(), 1));
  }

  std::string_view rest_;
  char separator_;
  std::size_t line_{1};
  bool row_ended_{true};
};

}  // namespace

Result<std::vector<CsvRow>, FormatError> split_csv(std::string_view text, char separator) {
  std::vector<CsvRow> rows;
  CellReader reader{text, separator};
  while (!reader.at_end() || !reader.row_ended()) {
    if (reader.row_ended()) rows.push_back({.line = reader.line(), .cells = {}});
    auto cell = reader.take();
    if (!cell) return fail(cell.error());
    rows.back().cells.push_back(std::move(*cell));
  }
  std::erase_if(rows, [](const CsvRow& row) {
    return std::ranges::all_of(row.cells, [](std::string_view cell) { return trimmed(cell).empty(); });
  });
  return rows;
}

std::string csv_cell(std::string_view text) {
  const bool is_plain = text.find_first_of(",;\t\"\r\n") == std::string_view::npos && trimmed(text) == text;
  if (is_plain) return std::string{text};
  std::string cell{'"'};
  for (const char c : text) cell.append(c == '"' ? 2 : 1, c);
  return cell + '"';
}

}  // namespace ponte::planning
