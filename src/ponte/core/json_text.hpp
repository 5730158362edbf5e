#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace ponte {

/// Writes one JSON object per line without building a tree: members are appended in the order of the calls, and
/// commas follow by themselves. Every value survives exactly: what a JSON number cannot carry (NaN, infinities,
/// integers beyond 2^53) is written as a string.
class JsonText {
 public:
  JsonText& begin_object();
  JsonText& end_object();
  JsonText& begin_array();
  JsonText& end_array();
  JsonText& key(std::string_view name);

  JsonText& value(std::string_view text);  ///< bytes that are not UTF-8 are written as the Latin-1 character
  JsonText& value(const char* text) { return value(std::string_view{text}); }
  JsonText& value(bool truth);
  JsonText& value(double number);  ///< shortest text that reads back as the same double
  JsonText& value(float number);   ///< shortest text that reads back as the same float
  JsonText& value(std::int64_t number);
  JsonText& value(std::uint64_t number);
  JsonText& value(int number) { return value(std::int64_t{number}); }
  JsonText& value(unsigned number) { return value(std::uint64_t{number}); }
  JsonText& written(std::string_view json);  ///< a value that is JSON text already

  template <class T>
  JsonText& member(std::string_view name, T number) {
    return key(name).value(number);
  }

  [[nodiscard]] const std::string& text() const { return text_; }
  /// Forgets what was written and keeps the memory, for the next line.
  void clear();

 private:
  void separate();

  std::string text_;
  bool needs_comma_{};
};

}  // namespace ponte
