#include "ponte/transport/line_reader.hpp"

#include "ponte/transport/test_witness.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace ponte::transport {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::wait_for;

struct LineReaderTest : ::testing::Test {
  LineReaderTest() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    source = FileDescriptor{ends[0]};
    sink = FileDescriptor{ends[1]};
  }

  void write(std::string_view text) const {
    ASSERT_EQ(::write(sink.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void start(FileDescriptor input) {
    reader = std::make_unique<LineReader>(
        loop, std::move(input),
        [this](std::string_view line) {
          lines.emplace_back(line);
          if (line == "destroy") reader.reset();
        },
        [this](std::string_view reason) { end = reason; });
  }

  Loop loop;
  FileDescriptor source;
  FileDescriptor sink;
  std::vector<std::string> lines;
  std::string end;
  std::unique_ptr<LineReader> reader;
};

TEST_F(LineReaderTest, ReadsLinesInPiecesOfAnySize) {
  start(std::move(source));
  write("one\ntwo\n\nthr");
  EXPECT_TRUE(wait_for(loop, [&] { return lines.size() == 3; }));
  write("ee\nfour");
  EXPECT_TRUE(wait_for(loop, [&] { return lines.size() == 4; }));
  EXPECT_EQ(end, "");
  sink = {};
  EXPECT_TRUE(wait_for(loop, [&] { return !end.empty(); }));
  EXPECT_THAT(lines, ElementsAre("one", "two", "", "three", "four"));
}

TEST_F(LineReaderTest, ReadsAFile) {
  std::string name = "/tmp/ponte_lines_XXXXXX";
  FileDescriptor file{::mkstemp(name.data())};
  ASSERT_EQ(::unlink(name.data()), 0);
  ASSERT_EQ(::write(file.get(), "one\ntwo\n", 8), 8);
  ASSERT_EQ(::lseek(file.get(), 0, SEEK_SET), 0);
  start(std::move(file));
  EXPECT_TRUE(wait_for(loop, [&] { return !end.empty(); }));
  EXPECT_THAT(lines, ElementsAre("one", "two"));
}

TEST_F(LineReaderTest, EndsAtALineThatIsTooLong) {
  start(std::move(source));
  write("short\n" + std::string(LineReader::line_limit, 'x') + "\nnever\n");
  EXPECT_TRUE(wait_for(loop, [&] { return !end.empty(); }));
  EXPECT_THAT(lines, ElementsAre("short"));
  EXPECT_THAT(end, HasSubstr("longer than 4096"));
}

TEST_F(LineReaderTest, MayBeDestroyedByALineOrWhileItWaits) {
  start(std::move(source));
  write("destroy\nnever\n");
  EXPECT_TRUE(wait_for(loop, [&] { return reader == nullptr; }));
  loop.run_for(1ms);
  EXPECT_THAT(lines, ElementsAre("destroy"));

  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  sink = FileDescriptor{ends[1]};
  start(FileDescriptor{ends[0]});
  loop.run_for(1ms);
  reader.reset();
  loop.run_for(1ms);
  EXPECT_EQ(end, "");
}

}  // namespace
}  // namespace ponte::transport
