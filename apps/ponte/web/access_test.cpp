#include "web/access.hpp"

#include <gtest/gtest.h>

namespace ponte::app {
namespace {

using namespace std::chrono_literals;

const Tokens tokens{.watch = "watch-token-watch", .command = "command-token-command"};

/// Ids count up: 1, 2, 3...
std::function<std::string()> counting() {
  return [count = 0]() mutable { return std::to_string(++count); };
}

TEST(Access, ExchangesATokenForASession) {
  Access access{tokens, counting()};
  EXPECT_TRUE(access.needs_session());
  EXPECT_EQ(access.role_of(""), std::nullopt);
  const auto watcher = access.open({}, tokens.watch);
  const auto commander = access.open({}, tokens.command);
  ASSERT_TRUE(watcher && commander);
  EXPECT_EQ(access.role_of("ponte_session=" + watcher->id), Role::watch);
  EXPECT_EQ(access.role_of("a=b; ponte_session=" + commander->id), Role::command);
  EXPECT_EQ(access.role_of("ponte_session=3"), std::nullopt);
  EXPECT_EQ(access.role_of("other_ponte_session=1"), std::nullopt);
  EXPECT_EQ(access.role_of("ponte_session="), std::nullopt);
}

TEST(Access, RefusesWrongTokens) {
  Access access{{.watch = {}, .command = tokens.command}, counting()};
  for (const std::string_view token : {"", "command-token-comman", "command-token-command ", "watch-token-watch"}) {
    const auto session = access.open(Timestamp{Duration{token.size() * 1s}}, token);
    ASSERT_FALSE(session) << token;
    EXPECT_EQ(session.error(), Access::Refusal::wrong_token);
  }
}

TEST(Access, MayBeTriedAFewTimesASecond) {
  Access access{tokens, counting()};
  for (unsigned i = 0; i < Access::tries_per_second; ++i) EXPECT_FALSE(access.open({}, "guess"));
  const auto session = access.open({}, tokens.command);
  ASSERT_FALSE(session);
  EXPECT_EQ(session.error(), Access::Refusal::too_often);
  EXPECT_TRUE(access.open(Timestamp{Duration{1s}}, tokens.command));
}

TEST(Access, AClosedSessionIsVoid) {
  Access access{tokens, counting()};
  const auto cookie = "ponte_session=" + access.open({}, tokens.command)->id;
  access.close("ponte_session=another");
  EXPECT_TRUE(access.role_of(cookie));
  access.close(cookie);
  EXPECT_FALSE(access.role_of(cookie));
}

TEST(Access, TheOldestSessionGivesWay) {
  Access access{tokens, counting()};
  for (std::size_t i = 0; i <= Access::session_limit; ++i)
    ASSERT_TRUE(access.open(Timestamp{Duration{i * 1s}}, tokens.watch));
  EXPECT_FALSE(access.role_of("ponte_session=1"));
  EXPECT_TRUE(access.role_of("ponte_session=2"));
}

TEST(Access, WithoutTokensEverybodyMayCommand) {
  Access access{{}, counting()};
  EXPECT_FALSE(access.needs_session());
  EXPECT_EQ(access.role_of(""), Role::command);
  EXPECT_TRUE(access.open({}, "anything"));
}

}  // namespace
}  // namespace ponte::app
