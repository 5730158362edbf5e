#include "codegen/digest.hpp"

#include "ponte/definitions/mavlink_reader.hpp"
#include "ponte/definitions/test_tools.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace ponte::codegen {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Messages A (1) on line 2 and B (2) on line 3.
Protocol two_messages() {
  return read_mavlink_text(
      "<mavlink><messages>\n"
      "<message id='1' name='A'><field type='uint8_t' name='x'/></message>\n"
      "<message id='2' name='B'><field type='float' name='y'/></message>\n"
      "</messages></mavlink>",
      "test.xml");
}

std::string line_of(const Message& message) {
  return fmt::format("{} {} {} {} {}", message.number, message.crc_extra, message.base_length, message.full_length,
                     message.name);
}

struct Checked {
  std::string refusal;
  std::string file;
};

/// The refusal when `digest` is the committed table.
Checked check(const Protocol& protocol, std::string_view digest) {
  const TemporaryFolder folder;
  const auto file = folder.write("digest.txt", digest);
  return {refusal_of([&] {
            check_digest(protocol, file);
            return 0;
          }),
          file.string()};
}

TEST(Digest, AcceptsWhatItWasMadeOf) {
  EXPECT_EQ(check(two_messages(), digest_of(two_messages())).refusal, "(nothing was refused)");
}

TEST(Digest, NamesAMessageThatChanged) {
  auto protocol = two_messages();
  const auto digest = digest_of(protocol);
  const auto before = line_of(protocol.messages[1]);
  protocol.messages[1].crc_extra ^= 1U;
  const auto [refusal, file] = check(protocol, digest);
  EXPECT_THAT(refusal, StartsWith(file + ": the definitions differ from the digest in 1 messages."));
  EXPECT_THAT(refusal, EndsWith(fmt::format("\n  test.xml:3: '{}', the digest has '{}'", line_of(protocol.messages[1]),
                                            before)));
}

TEST(Digest, NoticesALengthAloneThatChanged) {
  auto protocol = two_messages();
  const auto digest = digest_of(protocol);
  protocol.messages[0].full_length = 2;
  EXPECT_THAT(check(protocol, digest).refusal, HasSubstr("\n  test.xml:2: '"));
}

TEST(Digest, NamesAMessageThatIsMissing) {
  auto protocol = two_messages();
  const auto digest = digest_of(protocol);
  const auto gone = line_of(protocol.messages[1]);
  protocol.messages.pop_back();
  const auto [refusal, file] = check(protocol, digest);
  EXPECT_THAT(refusal, EndsWith(fmt::format("\n  {}:3: 'no such message', the digest has '{}'", file, gone)));
}

TEST(Digest, NamesAMessageThatIsNew) {
  auto protocol = two_messages();
  auto older = protocol;
  older.messages.erase(older.messages.begin());
  EXPECT_THAT(check(protocol, digest_of(older)).refusal,
              EndsWith(fmt::format("\n  test.xml:2: '{}', the digest has 'nothing'", line_of(protocol.messages[0]))));
}

TEST(Digest, CountsTheDifferencesThatItDoesNotTell) {
  Protocol protocol{"many", {}, {}, {}};
  for (std::uint32_t number = 1; number <= 23; ++number) {
    auto message = two_messages().messages[0];
    message.number = number;
    protocol.messages.push_back(message);
  }
  const auto refusal = check(protocol, "# none\n").refusal;
  EXPECT_THAT(refusal, HasSubstr("differ from the digest in 23 messages."));
  EXPECT_THAT(refusal, HasSubstr("'20 "));
  EXPECT_THAT(refusal, Not(HasSubstr("'21 ")));
  EXPECT_THAT(refusal, EndsWith("\n  and 3 more"));
}

TEST(Digest, NamesTheLineThatIsNoEntry) {
  const auto [refusal, file] = check(two_messages(), "# comment\n\nHEARTBEAT 50\n");
  EXPECT_EQ(refusal, file + ":3: 'HEARTBEAT 50': a message id was expected first");
}

TEST(Digest, RefusesAMissingFile) {
  EXPECT_EQ(refusal_of([] {
              check_digest(two_messages(), "/nowhere/digest.txt");
              return 0;
            }),
            "/nowhere/digest.txt: cannot be read");
}

}  // namespace
}  // namespace ponte::codegen
