#pragma once

#include "ponte/core/time.hpp"
#include "ponte/vsm/view/client_feed.hpp"

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ponte::app {

using vsm::view::Role;

/// The secrets that people show; an empty one is none. Without any, everybody may command.
struct Tokens {
  static constexpr std::size_t size_min = 16;
  static constexpr std::size_t size_max = 128;

  std::string watch{};
  std::string command{};

  [[nodiscard]] bool any() const { return !watch.empty() || !command.empty(); }
};

/// Who may do what: exchanges tokens for sessions, and knows the sessions. Knows no clock; ids of sessions come from
/// outside, so that tests may choose them.
class Access {
 public:
  static constexpr std::size_t session_limit = 256;  ///< the oldest gives way
  static constexpr unsigned tries_per_second = 5;

  /// `new_id` returns what nobody can guess.
  Access(const Tokens& tokens, std::function<std::string()> new_id);

  struct Session {
    std::string id;
    Role role{};
  };
  enum class Refusal : std::uint8_t { wrong_token, too_often };
  [[nodiscard]] Result<Session, Refusal> open(Timestamp now, std::string_view token);
  /// What the holder of that Cookie header may do; nothing without a session.
  [[nodiscard]] std::optional<Role> role_of(std::string_view cookies) const;
  void close(std::string_view cookies);

  /// False: there are no tokens, and everybody has the role `command`.
  [[nodiscard]] bool needs_session() const { return needs_session_; }

 private:
  // Secrets are compared by their digests, in a time that does not tell how much of them was right.
  using Digest = std::array<unsigned char, 32>;
  struct Entry {
    Digest id;
    Role role;
  };

  static Digest digest(std::string_view text);
  static bool same(const Digest& a, const Digest& b);
  [[nodiscard]] const Entry* find(std::string_view cookies) const;

  std::optional<Digest> watch_;
  std::optional<Digest> command_;
  bool needs_session_;
  std::function<std::string()> new_id_;
  std::deque<Entry> sessions_;
  Timestamp second_began_{};
  unsigned tries_{};
};

}  // namespace ponte::app
