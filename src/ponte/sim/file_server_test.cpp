#include "ponte/sim/file_server.hpp"

#include "ponte/sim/test_station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::sim {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class FileServerTest : public ::testing::Test {
 protected:
  FileServerTest() { station_.wait(seconds{9}); }

  void ask(FtpOpcode opcode, Bytes data, std::uint8_t session = 0, std::uint32_t offset = 0) {
    FtpMessage request{.sequence = sequence_ += 2, .session = session, .opcode = opcode, .offset = offset};
    request.set_bytes(data);
    resend(request);
  }
  void resend(const FtpMessage& request) {
    station_.forget();
    last_request_ = request;
    station_.send(messages::FileTransferProtocol{
        .target_system = 1, .target_component = 1, .payload = mavlink::write_ftp(request)});
  }

  std::vector<FtpMessage> answers() const {
    std::vector<FtpMessage> result;
    for (const auto& each : station_.all<messages::FileTransferProtocol>())
      result.push_back(mavlink::read_ftp(each.payload));
    return result;
  }
  FtpMessage answer(FtpOpcode opcode, std::string_view data, std::uint8_t session = 0, std::uint32_t offset = 0) {
    ask(opcode, bytes_of(data), session, offset);
    return answers().at(0);
  }
  FtpError error(FtpOpcode opcode, std::string_view data, std::uint8_t session = 0, std::uint32_t offset = 0) {
    const auto refusal = answer(opcode, data, session, offset);
    EXPECT_EQ(refusal.opcode, FtpOpcode::nak);
    return static_cast<FtpError>(refusal.data[0]);
  }

  /// The whole file, by one burst after the other.
  std::vector<std::byte> read(std::string_view path) {
    const auto opened = answer(FtpOpcode::open_read_only, path);
    EXPECT_EQ(opened.opcode, FtpOpcode::ack);
    std::vector<std::byte> content;
    for (bool at_end = false; !at_end;) {
      ask(FtpOpcode::burst_read_file, {}, opened.session, static_cast<std::uint32_t>(content.size()));
      station_.wait(seconds{2});
      for (const auto& each : answers()) {
        at_end = each.opcode == FtpOpcode::nak;
        if (at_end) break;
        EXPECT_EQ(each.offset, content.size());
        content.insert(content.end(), each.bytes().begin(), each.bytes().end());
      }
    }
    EXPECT_EQ(content.size(), load_le<std::uint32_t>(opened.data.data()));
    ask(FtpOpcode::terminate_session, {}, opened.session);
    return content;
  }

  FtpOpcode write(std::string_view path, const std::vector<std::byte>& content) {
    const auto opened = answer(FtpOpcode::create_file, path);
    EXPECT_EQ(opened.opcode, FtpOpcode::ack);
    for (std::size_t at = 0; at < content.size(); at += 100)
      ask(FtpOpcode::write_file, Bytes{content}.subspan(at, std::min<std::size_t>(100, content.size() - at)),
          opened.session, static_cast<std::uint32_t>(at));
    return answer(FtpOpcode::terminate_session, "", opened.session).opcode;
  }

  static std::vector<std::byte> plan(std::size_t count) {
    std::vector<std::byte> content(10 + 38 * count);
    store_le(&content[0], std::uint16_t{0x763D});
    store_le(&content[8], static_cast<std::uint16_t>(count));
    for (std::size_t i = 0; i < count; ++i) {
      auto* const item = &content[10 + 38 * i];
      store_le(item + 16, std::int32_t{-300'699'000});
      store_le(item + 20, std::int32_t{-511'209'600});
      store_le(item + 24, 40.0F);
      store_le(item + 28, static_cast<std::uint16_t>(i));
      store_le(item + 30, std::uint16_t{messages::MAV_CMD_NAV_WAYPOINT});
      item[34] = std::byte{messages::MAV_FRAME_GLOBAL_RELATIVE_ALT};
    }
    return content;
  }

  TestStation station_{{.fly_square = false}};
  FtpMessage last_request_;
  std::uint16_t sequence_{};
};

TEST_F(FileServerTest, ListsItsDirectories) {
  const auto root = answer(FtpOpcode::list_directory, "/");
  EXPECT_EQ(root.path(), "D@MISSION");
  const auto missions = answer(FtpOpcode::list_directory, "@MISSION", 0, 1);
  EXPECT_EQ(missions.path(), "Ffence.dat\t10");
  EXPECT_EQ(error(FtpOpcode::list_directory, "@MISSION", 0, 3), FtpError::end_of_file);
  EXPECT_EQ(error(FtpOpcode::list_directory, "/nowhere"), FtpError::not_found);
}

TEST_F(FileServerTest, GivesAndTakesAMission) {
  ASSERT_EQ(write("@MISSION/mission.dat", plan(20)), FtpOpcode::ack);
  const auto content = read("@MISSION/mission.dat");
  ASSERT_THAT(content, SizeIs(10 + 38 * 20));
  EXPECT_EQ(u16_le(content, 8), 20);
  EXPECT_EQ(load_le<std::int32_t>(&content[10 + 38 + 16]), -300'699'000);
}

TEST_F(FileServerTest, ReplacesOrKeepsWhatWasThere) {
  ASSERT_EQ(write("@MISSION/mission.dat", plan(20)), FtpOpcode::ack);
  auto part = plan(2);
  store_le(&part[4], std::uint16_t{1});  // keeps the others
  store_le(&part[6], std::uint16_t{5});  // and begins here
  ASSERT_EQ(write("@MISSION/mission.dat", part), FtpOpcode::ack);
  EXPECT_THAT(read("@MISSION/mission.dat"), SizeIs(10 + 38 * 20));
  ASSERT_EQ(write("@MISSION/mission.dat", plan(3)), FtpOpcode::ack);
  EXPECT_THAT(read("@MISSION/mission.dat"), SizeIs(10 + 38 * 3));
}

TEST_F(FileServerTest, RefusesAFileThatIsNoPlanAndKeepsTheOld) {
  ASSERT_EQ(write("@MISSION/mission.dat", plan(3)), FtpOpcode::ack);
  auto wrong = plan(4);
  wrong.pop_back();
  EXPECT_EQ(write("@MISSION/mission.dat", wrong), FtpOpcode::nak) << "cut off";
  wrong = plan(4);
  wrong[0] = std::byte{0};
  EXPECT_EQ(write("@MISSION/mission.dat", wrong), FtpOpcode::nak) << "no magic";
  wrong = plan(4);
  store_le(&wrong[10 + 30], std::uint16_t{30'999});
  EXPECT_EQ(write("@MISSION/mission.dat", wrong), FtpOpcode::nak) << "an unknown command";
  EXPECT_EQ(write("@MISSION/mission.dat", plan(2000)), FtpOpcode::nak) << "too many";
  EXPECT_THAT(read("@MISSION/mission.dat"), SizeIs(10 + 38 * 3));
}

TEST_F(FileServerTest, GivesAllParameters) {
  const auto content = read("@PARAM/param.pck");
  EXPECT_EQ(u16_le(content, 0), 0x671B);
  EXPECT_EQ(u16_le(content, 2), u16_le(content, 4));
  const std::string text{reinterpret_cast<const char*>(content.data()), content.size()};
  EXPECT_NE(text.find("FORMAT_VERSION"), std::string::npos);
  EXPECT_EQ(u16_le(read("@PARAM/param.pck?start=5&count=7"), 2), 7);
}

TEST_F(FileServerTest, AnswersARepeatedRequestAlike) {
  const auto opened = answer(FtpOpcode::open_read_only, "@PARAM/param.pck");
  resend(last_request_);
  EXPECT_EQ(answers().at(0).session, opened.session);
  EXPECT_EQ(answers().at(0).sequence, opened.sequence);
  EXPECT_EQ(error(FtpOpcode::open_read_only, "@PARAM/param.pck"), FtpError::fail) << "not a repetition";
}

TEST_F(FileServerTest, EndsSessionsThatAreNotUsed) {
  const auto opened = answer(FtpOpcode::open_read_only, "@PARAM/param.pck");
  station_.wait(milliseconds{19'900});
  EXPECT_EQ(answer(FtpOpcode::read_file, "", opened.session).opcode, FtpOpcode::ack);
  station_.wait(milliseconds{20'100});
  EXPECT_EQ(error(FtpOpcode::read_file, "", opened.session), FtpError::not_found);
}

TEST_F(FileServerTest, TheClientNumbersItsSessions) {
  const auto opened = answer(FtpOpcode::create_file, "@MISSION/mission.dat", 77);
  EXPECT_EQ(opened.opcode, FtpOpcode::ack);
  EXPECT_EQ(opened.session, 77);
  EXPECT_EQ(answer(FtpOpcode::write_file, "not a plan", 77).opcode, FtpOpcode::ack);
  EXPECT_EQ(error(FtpOpcode::write_file, "not a plan", 78), FtpError::not_found);
  EXPECT_EQ(error(FtpOpcode::read_file, "", 77), FtpError::fail) << "it is open for writing";
  EXPECT_EQ(error(FtpOpcode::terminate_session, "", 77), FtpError::fail) << "no plan was written";
}

TEST_F(FileServerTest, OpensAnotherFileInASessionThatWasForgotten) {
  EXPECT_EQ(answer(FtpOpcode::open_read_only, "@PARAM/param.pck").opcode, FtpOpcode::ack);
  station_.wait(milliseconds{3100});
  EXPECT_EQ(answer(FtpOpcode::open_read_only, "@MISSION/mission.dat").opcode, FtpOpcode::ack);
}

TEST_F(FileServerTest, HasFiveSessions) {
  for (std::uint8_t i = 0; i < 5; ++i)
    EXPECT_EQ(answer(FtpOpcode::open_read_only, "@PARAM/param.pck", i).opcode, FtpOpcode::ack) << i;
  EXPECT_EQ(error(FtpOpcode::open_read_only, "@PARAM/param.pck", 5), FtpError::no_session_free);
  station_.wait(milliseconds{3100});
  EXPECT_EQ(answer(FtpOpcode::open_read_only, "@PARAM/param.pck", 5).opcode, FtpOpcode::ack) << "the others are idle";
  EXPECT_EQ(answer(FtpOpcode::reset_sessions, "").opcode, FtpOpcode::ack);
  EXPECT_EQ(answer(FtpOpcode::open_read_only, "@PARAM/param.pck", 5).opcode, FtpOpcode::ack);
}

TEST_F(FileServerTest, RefusesWhatItDoesNotHave) {
  EXPECT_EQ(error(FtpOpcode::open_read_only, "/etc/passwd"), FtpError::not_found);
  EXPECT_EQ(error(FtpOpcode::create_file, "@PARAM/param.pck"), FtpError::protected_file);
  EXPECT_EQ(error(static_cast<FtpOpcode>(77), ""), FtpError::unknown_command);
  EXPECT_EQ(error(FtpOpcode::read_file, "", 200), FtpError::not_found);
}

TEST_F(FileServerTest, ChecksumsAsMavftpDefines) {
  const auto sum = answer(FtpOpcode::calculate_crc32, "@MISSION/rally.dat");
  EXPECT_EQ(sum.size, 4);
  EXPECT_EQ(error(FtpOpcode::calculate_crc32, "@MISSION/no.dat"), FtpError::not_found);
}

TEST(FileServerOfPx4, IsNotThere) {
  TestStation station{{.personality = Personality::px4}};
  station.wait(seconds{9});
  station.send(messages::FileTransferProtocol{.target_system = 1, .target_component = 1});
  EXPECT_THAT(station.all<messages::FileTransferProtocol>(), IsEmpty());
}

}  // namespace
}  // namespace ponte::sim
