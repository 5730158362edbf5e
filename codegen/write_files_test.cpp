#include "codegen/emit.hpp"
#include "ponte/definitions/test_tools.hpp"

#include <chrono>

namespace ponte::codegen {
namespace {

namespace fs = std::filesystem;

std::string generated(std::string_view text) { return std::string{generated_notice} + std::string{text}; }

/// Gives the file a time long ago, so that a later write shows.
fs::file_time_type make_old(const fs::path& file) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours{24});
  return fs::last_write_time(file);
}

TEST(WriteFiles, MakesTheFoldersItNeeds) {
  const TemporaryFolder folder;
  write_files({{"a/b/c.hpp", generated("1")}}, folder.path() / "new");
  EXPECT_EQ(read_file(folder.path() / "new/a/b/c.hpp"), generated("1"));
}

TEST(WriteFiles, LeavesAnUnchangedFileAlone) {
  const TemporaryFolder folder;
  write_files({{"same.hpp", generated("1")}, {"other.hpp", generated("1")}}, folder.path());
  const auto same = make_old(folder.path() / "same.hpp");
  const auto other = make_old(folder.path() / "other.hpp");
  write_files({{"same.hpp", generated("1")}, {"other.hpp", generated("2")}}, folder.path());
  EXPECT_EQ(fs::last_write_time(folder.path() / "same.hpp"), same);
  EXPECT_NE(fs::last_write_time(folder.path() / "other.hpp"), other);
  EXPECT_EQ(read_file(folder.path() / "other.hpp"), generated("2"));
}

TEST(WriteFiles, RemovesWhatIsNoLongerGenerated) {
  const TemporaryFolder folder;
  write_files({{"stay.hpp", generated("1")}, {"deep/go.hpp", generated("1")}}, folder.path());
  write_files({{"stay.hpp", generated("1")}}, folder.path());
  EXPECT_TRUE(fs::exists(folder.path() / "stay.hpp"));
  EXPECT_FALSE(fs::exists(folder.path() / "deep/go.hpp"));
}

// `--output .` in the wrong folder would have emptied it.
TEST(WriteFiles, SparesFilesThatItDidNotGenerate) {
  const TemporaryFolder folder;
  const auto thesis = folder.write("thesis.txt", "years of work");
  write_files({{"a.hpp", generated("1")}}, folder.path());
  EXPECT_EQ(read_file(thesis), "years of work");
}

TEST(WriteFiles, SaysWhichFileCannotBeWritten) {
  const TemporaryFolder folder;
  const auto blocked = folder.path() / "a.hpp";
  fs::create_directories(blocked);
  EXPECT_EQ(refusal_of([&] {
              write_files({{"a.hpp", generated("1")}}, folder.path());
              return 0;
            }),
            blocked.string() + ": cannot be read");
}

}  // namespace
}  // namespace ponte::codegen
