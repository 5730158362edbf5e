#include "codegen/names.hpp"

#include <algorithm>
#include <array>
#include <cctype>

namespace ponte::codegen {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }
char upper(char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); }

constexpr auto keywords = std::to_array<std::string_view>(
    {"and",    "auto",    "bool",     "break",    "case",     "char",     "class",  "const",   "continue", "default",
     "delete", "do",      "double",   "else",     "enum",     "explicit", "export", "extern",  "false",    "float",
     "for",    "friend",  "goto",     "if",       "inline",   "int",      "long",   "new",     "not",      "operator",
     "or",     "private", "public",   "register", "requires", "return",   "short",  "signed",  "sizeof",   "static",
     "struct", "switch",  "template", "this",     "throw",    "true",     "try",    "typedef", "union",    "unsigned",
     "using",  "virtual", "void",     "volatile", "while",    "xor"});
/// What every generated struct declares itself.
constexpr auto taken_names = std::to_array<std::string_view>({"fields", "info", "visit"});

}  // namespace

std::string snake_case(std::string_view name) {
  std::string result;
  for (const char c : name) {
    if (is_word(c))
      result += lower(c);
    else if (!result.empty() && result.back() != '_')
      result += '_';
  }
  while (!result.empty() && result.back() == '_') result.pop_back();
  if (std::ranges::find(keywords, result) != keywords.end() ||
      std::ranges::find(taken_names, result) != taken_names.end())
    result += '_';
  if (!result.empty() && std::isdigit(static_cast<unsigned char>(result.front())) != 0) result.insert(0, "_");
  return result;
}

std::string pascal_case(std::string_view name) {
  std::string result;
  bool begin = true;
  for (const char c : name) {
    if (!is_word(c)) {
      begin = true;
      continue;
    }
    result += begin ? upper(c) : lower(c);
    begin = false;
  }
  return result;
}

std::string literal(std::string_view text) {
  std::string result{'"'};
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + '"';
}

std::string one_line(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!space)
      result += c;
    else if (!result.empty() && result.back() != ' ')
      result += ' ';
  }
  while (!result.empty() && (result.back() == ' ' || result.back() == '\\')) result.pop_back();
  return result;
}

}  // namespace ponte::codegen
