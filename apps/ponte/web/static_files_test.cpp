#include "web/static_files.hpp"

#include "common/failure.hpp"
#include "web/token_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace ponte::app {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Pair;

/// A folder that is gone after the test.
class Folder : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(root / "assets"); }
  void TearDown() override { fs::remove_all(root); }
  fs::path write(const std::string& name, std::string_view content) const {
    std::ofstream{root / name} << content;
    return root / name;
  }

  fs::path root = fs::path{::testing::TempDir()} /
                  ::testing::UnitTest::GetInstance()->current_test_info()->name();
};
using StaticFilesOf = Folder;
using TokenFile = Folder;

HttpResponse get(const StaticFiles& files, std::string path, bool gzip = false) {
  return files.get({.method = "GET", .path = std::move(path), .accepts_gzip = gzip});
}

TEST_F(StaticFilesOf, AFolderAreServed) {
  write("index.html", "page");
  write("assets/app-1234.js", "code");
  write("assets/app-1234.js.gz", "zipped");
  const StaticFiles files{root};
  EXPECT_EQ(get(files, "/").text(), "page");
  EXPECT_EQ(get(files, "/").type, "text/html; charset=utf-8");
  EXPECT_THAT(get(files, "/index.html").headers, Contains(Pair("Cache-Control", "no-cache")));
  const auto plain = get(files, "/assets/app-1234.js");
  EXPECT_EQ(plain.text(), "code");
  EXPECT_THAT(plain.headers, Contains(Pair("Cache-Control", HasSubstr("immutable"))));
  const auto zipped = get(files, "/assets/app-1234.js", true);
  EXPECT_EQ(zipped.text(), "zipped");
  EXPECT_EQ(zipped.type, "text/javascript; charset=utf-8");
  EXPECT_THAT(zipped.headers, Contains(Pair("Content-Encoding", "gzip")));
}

TEST_F(StaticFilesOf, NothingElseIsServed) {
  write("index.html", "page");
  const auto secret = write("../secret.txt", "secret");
  const StaticFiles files{root};
  for (const auto* path : {"/../secret.txt", "/%2e%2e/secret.txt", "/assets", "/assets/", "//index.html", "", "x"})
    EXPECT_EQ(get(files, path).status, 404U) << path;
  fs::remove(secret);
}

TEST_F(StaticFilesOf, AFolderWithoutAPageIsRefused) {
  EXPECT_THROW(StaticFiles{root}, Failure);
  EXPECT_THROW(StaticFiles{root / "missing"}, Failure);
}

TEST_F(TokenFile, IsReadWhenItIsItsOwnersAlone) {
  const auto path = write("tokens.toml", "command = \"0123456789abcdef\"\nwatch = \"fedcba9876543210\"\n");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  const auto tokens = read_token_file(path);
  EXPECT_EQ(tokens.command, "0123456789abcdef");
  EXPECT_EQ(tokens.watch, "fedcba9876543210");
  EXPECT_NO_THROW(check_tokens(path, tokens));
  fs::permissions(path, fs::perms::group_read, fs::perm_options::add);
  EXPECT_THROW((void)read_token_file(path), Failure);
}

TEST_F(TokenFile, IsRefusedWhenItHoldsAnythingElse) {
  for (const auto* content : {"", "command = 1", "command", "kommand = \"0123456789abcdef\""}) {
    const auto path = write("tokens.toml", content);
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
    EXPECT_THROW((void)read_token_file(path), Failure) << content;
  }
  EXPECT_THROW((void)read_token_file(root / "missing"), Failure);
  EXPECT_THROW(check_tokens("x", {.watch = {}, .command = "short"}), Failure);
  EXPECT_THROW(check_tokens("x", {.watch = "0123456789abcdef", .command = "0123456789abcdef"}), Failure);
}

}  // namespace
}  // namespace ponte::app
