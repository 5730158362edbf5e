#include "web/access.hpp"

#include <openssl/crypto.h>
#include <openssl/sha.h>

#include <utility>

namespace ponte::app {
namespace {

constexpr std::string_view cookie_name = "ponte_session=";

/// The value of our cookie among those of a Cookie header; empty when it is not there.
std::string_view session_in(std::string_view cookies) {
  while (!cookies.empty()) {
    const auto end = cookies.find(';');
    auto cookie = cookies.substr(0, end);
    cookie.remove_prefix(std::min(cookie.find_first_not_of(' '), cookie.size()));
    if (cookie.starts_with(cookie_name)) return cookie.substr(cookie_name.size());
    if (end == std::string_view::npos) break;
    cookies.remove_prefix(end + 1);
  }
  return {};
}

}  // namespace

Access::Access(const Tokens& tokens, std::function<std::string()> new_id)
    : needs_session_{tokens.any()}, new_id_{std::move(new_id)} {
  if (!tokens.watch.empty()) watch_ = digest(tokens.watch);
  if (!tokens.command.empty()) command_ = digest(tokens.command);
}

Access::Digest Access::digest(std::string_view text) {
  Digest result{};
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), result.data());
  return result;
}

bool Access::same(const Digest& a, const Digest& b) { return CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0; }

Result<Access::Session, Access::Refusal> Access::open(Timestamp now, std::string_view token) {
  if (!needs_session_) return Session{new_id_(), Role::command};
  if (now - second_began_ >= std::chrono::seconds{1}) {
    second_began_ = now;
    tries_ = 0;
  }
  if (++tries_ > tries_per_second) return fail(Refusal::too_often);
  const auto shown = digest(token);
  const bool commands = command_ && same(shown, *command_);
  const bool watches = watch_ && same(shown, *watch_);
  if (!commands && !watches) return fail(Refusal::wrong_token);
  Session session{new_id_(), commands ? Role::command : Role::watch};
  if (sessions_.size() == session_limit) sessions_.pop_front();
  sessions_.push_back({digest(session.id), session.role});
  return session;
}

const Access::Entry* Access::find(std::string_view cookies) const {
  const auto id = session_in(cookies);
  if (id.empty()) return nullptr;
  const auto shown = digest(id);
  const Entry* found = nullptr;
  for (const auto& entry : sessions_)
    if (same(entry.id, shown)) found = &entry;
  return found;
}

std::optional<Role> Access::role_of(std::string_view cookies) const {
  if (!needs_session_) return Role::command;
  const auto* entry = find(cookies);
  return entry == nullptr ? std::nullopt : std::optional{entry->role};
}

void Access::close(std::string_view cookies) {
  if (const auto* entry = find(cookies))
    std::erase_if(sessions_, [id = entry->id](const Entry& other) { return other.id == id; });
}

}  // namespace ponte::app
