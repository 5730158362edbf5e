#include "ponte/autopilot/file_client.hpp"

#include "ponte/autopilot/test_client.hpp"
#include "ponte/mavlink/autopilots/file_transfer_protocol.hpp"
#include "support/bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

using mavlink::FtpError;
using mavlink::FtpMessage;
using mavlink::FtpOpcode;
using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::station_component;
using testing::station_system;
using testing::TestFrame;
using Kind = FileFact::Kind;

class FileClientTest : public testing::ClientTest<FileClient, FileFact> {
 protected:
  FileClientTest() { use(Stack::ardupilot_copter); }

  std::vector<FtpMessage> said() {
    std::vector<FtpMessage> result;
    out_.drain([&](const OutgoingFrame& frame) {
      const auto view = mavlink::parse_frame(frame.bytes());
      result.push_back(mavlink::read_ftp(mavlink::decode<mavlink::autopilots::FileTransferProtocol>(*view).payload));
    });
    if (!result.empty()) last_ = result.back();
    return result;
  }

  void hear(const FtpMessage& message, mavlink::SystemId target = station_system) {
    client_->on_message(now_,
                        TestFrame{mavlink::autopilots::FileTransferProtocol{.target_system = target.value,
                                                                            .target_component = station_component.value,
                                                                            .payload = mavlink::write_ftp(message)}}
                            .view(),
                        voice_, facts_);
  }
  /// Answers what was said last.
  void acknowledge(Bytes data = {}, std::uint32_t offset = 0, unsigned later = 1, bool is_last = false) {
    (void)said();
    FtpMessage message{.sequence = static_cast<std::uint16_t>(last_.sequence + later),
                       .session = 3,
                       .opcode = FtpOpcode::ack,
                       .request = last_.opcode,
                       .burst_complete = is_last,
                       .offset = offset};
    message.set_bytes(data);
    hear(message);
  }
  void refuse(FtpError error, unsigned later = 1) {
    (void)said();
    FtpMessage message{.sequence = static_cast<std::uint16_t>(last_.sequence + later),
                       .session = 3,
                       .opcode = FtpOpcode::nak,
                       .request = last_.opcode};
    const std::array reason{static_cast<std::byte>(error)};
    message.set_bytes(reason);
    hear(message);
  }

  FtpMessage last_{};
};

TEST_F(FileClientTest, ReadsInABurstAndThenWhatIsMissing) {
  (void)client_->read(now_, "a", voice_);
  acknowledge(bytes("05 00 00 00"));
  const auto burst = said();
  ASSERT_THAT(burst, SizeIs(1));
  EXPECT_EQ(burst[0].opcode, FtpOpcode::burst_read_file);
  EXPECT_EQ(burst[0].session, 3);
  acknowledge(bytes("01 02"), 0, 1);
  acknowledge(bytes("05"), 4, 3);  // the one between was lost
  refuse(FtpError::end_of_file, 4);
  const auto gap = said();
  ASSERT_THAT(gap, SizeIs(1));
  EXPECT_EQ(gap[0].opcode, FtpOpcode::read_file);
  EXPECT_EQ(gap[0].offset, 2U);
  EXPECT_EQ(gap[0].size, 2);
  acknowledge(bytes("03 04"), 2);
  EXPECT_EQ(said().at(0).offset, 5U) << "whether there is more";
  refuse(FtpError::end_of_file);
  EXPECT_EQ(said().at(0).opcode, FtpOpcode::terminate_session);
  acknowledge();
  EXPECT_THAT(facts(), ElementsAre(FileFact{.kind = Kind::was_read, .request = FileRequestId{1}, .bytes = 5}));
  EXPECT_EQ(client_->content(), bytes("01 02 03 04 05"));
}

TEST_F(FileClientTest, BurstsOnWhereTheLastBurstEnded) {
  (void)client_->read(now_, "a", voice_);
  acknowledge();
  acknowledge(bytes("01 02"), 0, 1, true);
  const auto next = said();
  ASSERT_THAT(next, SizeIs(1));
  EXPECT_EQ(next[0].opcode, FtpOpcode::burst_read_file);
  EXPECT_EQ(next[0].offset, 2U);
}

TEST_F(FileClientTest, DoesNotTakeALateBlockForOneOfItsOwn) {
  (void)client_->read(now_, "a", voice_);
  acknowledge();
  acknowledge(bytes("01 02"), 0, 0);  // of a burst before
  hear({.sequence = 3, .opcode = FtpOpcode::ack, .size = 1, .request = FtpOpcode::burst_read_file},
       mavlink::SystemId{254});
  EXPECT_THAT(client_->content(), IsEmpty());
}

TEST_F(FileClientTest, RepeatsARequestWithItsNumber) {
  (void)client_->remove(now_, "a", voice_);
  const auto first = said();
  wait(milliseconds{500});
  const auto second = said();
  ASSERT_THAT(second, SizeIs(1));
  EXPECT_EQ(second[0].sequence, first.at(0).sequence);
  refuse(FtpError::not_found);  // the answer to the first was lost
  EXPECT_EQ(facts().at(0).kind, Kind::removed);
}

TEST_F(FileClientTest, OpensTheFileAgainWhenItsSessionIsGone) {
  (void)client_->read(now_, "a", voice_);
  acknowledge();
  acknowledge(bytes("01 02"), 0, 1);
  refuse(FtpError::bad_session, 2);
  EXPECT_EQ(said().at(0).opcode, FtpOpcode::open_read_only);
  EXPECT_THAT(client_->content(), IsEmpty());
}

TEST_F(FileClientTest, EndsItsOldSessionsWhenNoneIsFree) {
  (void)client_->read(now_, "a", voice_);
  refuse(FtpError::no_session_free);
  EXPECT_EQ(said().at(0).opcode, FtpOpcode::reset_sessions);
  acknowledge();
  EXPECT_EQ(said().at(0).opcode, FtpOpcode::open_read_only);
  refuse(FtpError::no_session_free);
  EXPECT_EQ(facts().at(0).error, FtpError::no_session_free);
}

TEST_F(FileClientTest, WritesBlockByBlock) {
  (void)client_->write(now_, "a", std::vector<std::byte>(240, std::byte{7}), voice_);
  EXPECT_EQ(said().at(0).opcode, FtpOpcode::create_file);
  acknowledge();
  EXPECT_EQ(said().at(0).size, 239);
  acknowledge();
  const auto second = said();
  EXPECT_EQ(second.at(0).size, 1);
  EXPECT_EQ(second.at(0).offset, 239U);
  acknowledge();
  EXPECT_EQ(said().at(0).opcode, FtpOpcode::terminate_session);
  acknowledge();
  EXPECT_THAT(facts(), ElementsAre(FileFact{.kind = Kind::written, .request = FileRequestId{1}, .bytes = 240}));
}

// A server that has closed the file by itself has thrown away what was written.
TEST_F(FileClientTest, WritesAgainWhatCouldNotBeClosed) {
  (void)client_->write(now_, "a", std::vector<std::byte>(5, std::byte{7}), voice_);
  acknowledge();
  acknowledge();
  EXPECT_EQ(said().at(0).opcode, FtpOpcode::terminate_session);
  wait(milliseconds{500});
  refuse(FtpError::bad_session);
  EXPECT_EQ(said().at(0).opcode, FtpOpcode::create_file);
  EXPECT_THAT(facts(), IsEmpty());
}

TEST_F(FileClientTest, ListsADirectoryAndLeavesOutWhatIsSkipped) {
  (void)client_->list(now_, "@MISSION", voice_);
  acknowledge(bytes_of(std::string_view{"Fmission.dat\t48\0Dold\0S\0", 23}));
  EXPECT_EQ(said().at(0).offset, 3U);
  refuse(FtpError::end_of_file);
  EXPECT_EQ(facts().at(0).kind, Kind::listed);
  EXPECT_THAT(client_->entries(), ElementsAre(FileEntry{"mission.dat", false, 48}, FileEntry{"old", true, 0}));
}

TEST_F(FileClientTest, TellsTheChecksumOnBoard) {
  EXPECT_EQ(ftp_checksum(bytes_of(std::string_view{"123456789"})), 0x2DFD2D88U);
  (void)client_->checksum(now_, "a", voice_);
  acknowledge(bytes("88 2d fd 2d"));
  EXPECT_EQ(facts().at(0).checksum, 0x2DFD2D88U);
}

TEST_F(FileClientTest, TellsWhyItHasFailed) {
  (void)client_->read(now_, "a", voice_);
  refuse(FtpError::not_found);
  EXPECT_THAT(facts(), ElementsAre(FileFact{.kind = Kind::failed,
                                            .request = FileRequestId{1},
                                            .failure = FileFailure::refused,
                                            .error = FtpError::not_found}));
  (void)client_->read(now_, "a", voice_);
  wait(seconds{15});
  EXPECT_EQ(facts().at(0).failure, FileFailure::silent);
  (void)client_->read(now_, "a", voice_);
  acknowledge();
  acknowledge(bytes("01"), FileClient::size_limit);
  EXPECT_EQ(facts().at(0).failure, FileFailure::too_large);
}

TEST_F(FileClientTest, RefusesWhatCannotBegin) {
  EXPECT_EQ(client_->read(now_, "", voice_), fail(FileRefusal::bad_path));
  EXPECT_EQ(client_->read(now_, std::string(239, 'a'), voice_), fail(FileRefusal::bad_path));
  EXPECT_EQ(client_->write(now_, "a", std::vector<std::byte>(FileClient::size_limit + 1), voice_),
            fail(FileRefusal::too_large));
  (void)client_->read(now_, "a", voice_);
  EXPECT_EQ(client_->list(now_, "b", voice_), fail(FileRefusal::busy));
}

}  // namespace
}  // namespace ponte::autopilot
