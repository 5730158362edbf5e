#include "web/token_file.hpp"

#include "common/failure.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <toml++/toml.h>

#include <cerrno>
#include <cstring>

namespace ponte::app {

Tokens read_token_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) throw Failure{fmt::format("{}: {}", path, std::strerror(errno))};
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    throw Failure{fmt::format("{}: others may use it; expected a file of its owner alone: chmod 600", path)};
  Tokens tokens;
  try {
    for (const auto& [key, value] : toml::parse_file(path)) {
      const auto text = value.value<std::string>();
      if ((key != "command" && key != "watch") || !text)
        throw Failure{fmt::format("{}:{}: {}: expected command = \"...\" or watch = \"...\"", path,
                                  key.source().begin.line, key.str())};
      (key == "command" ? tokens.command : tokens.watch) = *text;
    }
  } catch (const toml::parse_error& error) {
    // What is on the line may be half a secret, so it is not repeated.
    throw Failure{fmt::format("{}:{}: expected TOML: command = \"...\"", path, error.source().begin.line)};
  }
  if (!tokens.any()) throw Failure{fmt::format("{}: has no token; expected command = \"...\"", path)};
  return tokens;
}

void check_tokens(const std::string& place, const Tokens& tokens) {
  for (const auto& token : {tokens.command, tokens.watch})
    if (!token.empty() && (token.size() < Tokens::size_min || token.size() > Tokens::size_max))
      throw Failure{fmt::format("{}: expected tokens of {} to {} characters", place, Tokens::size_min,
                                Tokens::size_max)};
  if (tokens.any() && tokens.command == tokens.watch)
    throw Failure{fmt::format("{}: expected different tokens for command and watch", place)};
}

}  // namespace ponte::app
