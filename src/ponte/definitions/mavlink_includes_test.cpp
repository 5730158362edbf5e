#include "ponte/definitions/mavlink_reader.hpp"

#include "ponte/definitions/test_tools.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace ponte::definitions {
namespace {

using testing::ElementsAre;

std::string including(std::string_view file, std::string_view rest = "") {
  return fmt::format("<mavlink>\n<include>{}</include>\n{}</mavlink>", file, rest);
}

constexpr auto message_a =
    "<mavlink><messages><message id='1' name='A'><field type='uint8_t' name='x'/></message></messages></mavlink>";

TEST(MavlinkIncludes, ReadsAFileThatTwoFilesIncludeOnce) {
  const TemporaryFolder folder;
  folder.write("base.xml", message_a);
  folder.write("left.xml", including("base.xml"));
  folder.write("right.xml", including("base.xml"));
  const auto top =
      folder.write("top.xml", "<mavlink><include>left.xml</include><include>right.xml</include></mavlink>");
  EXPECT_EQ(read_mavlink(top, {}).messages.size(), 1U);
}

TEST(MavlinkIncludes, EndsWhenFilesIncludeEachOther) {
  const TemporaryFolder folder;
  const auto first = folder.write("first.xml", including("second.xml"));
  folder.write("second.xml", including("first.xml",
                                       "<messages><message id='2' name='B'>"
                                       "<field type='uint8_t' name='x'/></message></messages>"));
  EXPECT_EQ(read_mavlink(first, {}).messages.size(), 1U);
}

TEST(MavlinkIncludes, LooksBesideTheIncludingFileBeforeTheSearchPath) {
  const TemporaryFolder folder;
  folder.write("elsewhere/base.xml", "<mavlink/>");
  folder.write("here/base.xml", message_a);
  const auto top = folder.write("here/top.xml", including(" base.xml\n"));
  EXPECT_EQ(read_mavlink(top, {folder.path() / "elsewhere"}).messages.size(), 1U);
}

TEST(MavlinkIncludes, FallsBackToTheSearchPath) {
  const TemporaryFolder folder;
  folder.write("elsewhere/base.xml", message_a);
  const auto top = folder.write("here/top.xml", including("base.xml"));
  EXPECT_EQ(read_mavlink(top, {folder.path() / "elsewhere"}).messages.size(), 1U);
}

TEST(MavlinkIncludes, NamesTheFileThatIsMissing) {
  const TemporaryFolder folder;
  const auto top = folder.write("top.xml", including("nowhere.xml"));
  EXPECT_EQ(refusal_of([&] { return read_mavlink(top, {folder.path()}); }),
            top.string() + ":2: included file 'nowhere.xml' was not found");
}

TEST(MavlinkIncludes, RefusesAnIncludeWithoutAName) {
  const TemporaryFolder folder;
  const auto top = folder.write("top.xml", including(""));
  EXPECT_EQ(refusal_of([&] { return read_mavlink(top, {folder.path()}); }),
            top.string() + ":2: included file '' was not found");
}

TEST(MavlinkIncludes, RefusesAChainThatIsTooLong) {
  const TemporaryFolder folder;
  for (int i = 0; i < 17; ++i) folder.write(fmt::format("{}.xml", i), including(fmt::format("{}.xml", i + 1)));
  folder.write("17.xml", "<mavlink/>");
  EXPECT_EQ(refusal_of([&] { return read_mavlink(folder.path() / "0.xml", {}); }),
            (folder.path() / "16.xml").string() + ":2: includes are nested too deeply");
  EXPECT_EQ(read_mavlink(folder.path() / "1.xml", {}).messages.size(), 0U) << "one less is allowed";
}

TEST(MavlinkIncludes, RefusesAFileThatIsNotThere) {
  const TemporaryFolder folder;
  const auto missing = folder.path() / "missing.xml";
  EXPECT_EQ(refusal_of([&] { return read_mavlink(missing, {}); }), missing.string() + ": cannot be read");
  EXPECT_EQ(refusal_of([&] { return read_mavlink(folder.path(), {}); }), folder.path().string() + ": cannot be read");
}

TEST(MavlinkIncludes, RefusesToIncludeIntoATextWithoutFiles) {
  EXPECT_EQ(refusal_of([] { return read_mavlink_text(including("/etc/passwd"), "test.xml"); }),
            "test.xml:2: '/etc/passwd' cannot be included into a text");
}

TEST(MavlinkIncludes, MergesTheEntriesOfAnEnumThatSeveralFilesDefine) {
  const TemporaryFolder folder;
  folder.write("base.xml", "<mavlink><enums><enum name='E'><entry name='E_B' value='2'/></enum></enums></mavlink>");
  const auto top = folder.write("top.xml", including("base.xml",
                                                     "<enums><enum name='E' bitmask='true'>"
                                                     "<entry name='E_A' value='1'/>"
                                                     "<entry name='E_B' value='2'/></enum></enums>"));
  const auto protocol = read_mavlink(top, {});
  const auto& merged = protocol.enumerations.at(0);
  std::vector<std::string> names;
  for (const auto& entry : merged.entries) names.push_back(entry.name);
  EXPECT_THAT(names, ElementsAre("E_A", "E_B"));
  EXPECT_TRUE(merged.bitmap);
}

TEST(MavlinkIncludes, NamesBothMessagesThatClaimOneId) {
  const TemporaryFolder folder;
  const auto base = folder.write("base.xml", message_a);
  const auto top = folder.write("top.xml", including("base.xml",
                                                     "<messages><message id='1' name='B'>"
                                                     "<field type='uint8_t' name='x'/></message></messages>"));
  EXPECT_EQ(refusal_of([&] { return read_mavlink(top, {}); }),
            fmt::format("{}:3: message B has the id 1 of A, defined at {}:1", top.string(), base.string()));
}

}  // namespace
}  // namespace ponte::definitions
