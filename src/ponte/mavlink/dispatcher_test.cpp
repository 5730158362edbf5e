#include "ponte/mavlink/dispatcher.hpp"

#include "ponte/mavlink/test_messages.hpp"
#include "support/bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

namespace ponte::mavlink {
namespace {

using testing::Attitude;
using ::testing::ElementsAre;
using testing::Heartbeat;
using ::testing::IsEmpty;
using testing::Statustext;

TEST(Dispatcher, HandsOutDecodedMessagesInTheOrderOfTheRequests) {
  std::vector<std::string> heard;
  Dispatcher dispatcher;
  dispatcher.on<Statustext>([&](const Statustext& text, const FrameView& frame) {
    heard.push_back(std::string{text.text.view()} + " " + std::to_string(frame.sequence));
  });
  dispatcher.on<Heartbeat>([&](const Heartbeat& heartbeat, const FrameView&) {
    heard.push_back("first " + std::to_string(heartbeat.custom_mode));
  });
  dispatcher.on<Heartbeat>([&](const Heartbeat&, const FrameView&) { heard.push_back("second"); });
  dispatcher.on_every_frame([&](const FrameView&, const MessageInfo* message) {
    heard.push_back(message == nullptr ? "unknown" : std::string{message->name});
  });

  Parser parser{testing::dialect};
  for (const auto* frame :
       {testing::heartbeat_frame, testing::attitude_frame, testing::statustext_frame, testing::radio_status_frame})
    parser.on_datagram(bytes(frame), dispatcher);
  EXPECT_THAT(heard,
              ElementsAre("HEARTBEAT", "first 4", "second", "ATTITUDE", "STATUSTEXT", "Init Gyro** 8", "unknown"));
}

TEST(Dispatcher, LeavesOutTheExtensionsOfAVersion1Frame) {
  const Statustext sent{.severity = 6, .text = std::string_view{"abc"}, .id = 7};
  std::array<std::byte, max_frame_size> out{};
  std::vector<std::uint16_t> ids;
  Dispatcher dispatcher;
  dispatcher.on<Statustext>([&](const Statustext& text, const FrameView&) { ids.push_back(text.id); });
  Parser parser{testing::dialect};
  for (const auto version : {Version::v2, Version::v1})
    parser.on_datagram(Bytes{out}.first(*encode(sent, {.version = version}, out)), dispatcher);
  EXPECT_THAT(ids, ElementsAre(7, 0));
}

TEST(Dispatcher, KnowsAMessageByWhatItIsOnTheWire) {
  auto newer = Heartbeat::info;
  newer.full_length = 12;
  auto other = Heartbeat::info;
  other.crc_extra = 51;
  std::vector<int> heard;
  Dispatcher dispatcher;
  dispatcher.on<Heartbeat>([&](const Heartbeat& heartbeat, const FrameView&) { heard.push_back(heartbeat.type); });
  const auto frame_bytes = bytes(testing::heartbeat_frame);
  const auto frame = *parse_frame(frame_bytes);
  dispatcher.on_frame(frame, &other);
  dispatcher.on_frame(frame, nullptr);
  EXPECT_THAT(heard, IsEmpty());
  dispatcher.on_frame(frame, &newer);
  EXPECT_THAT(heard, ElementsAre(2));
}

}  // namespace
}  // namespace ponte::mavlink
