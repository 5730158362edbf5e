#include "ponte/mavlink/json.hpp"

#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/test_messages.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>

namespace ponte::mavlink {
namespace {

std::string line(Bytes frame_bytes, const MessageInfo* message) {
  JsonText json;
  append_frame(json, wall_time_from_unix_us(1'700'000'000'000'001), *parse_frame(frame_bytes), message);
  return json.text();
}

TEST(AppendFrame, WritesTheLineOfTheDesign) {
  EXPECT_EQ(
      line(bytes(testing::attitude_frame), &testing::Attitude::info),
      R"({"time_us":1700000000000001,"id":30,"name":"ATTITUDE","version":2,"system":1,"component":1,"sequence":7,)"
      R"("fields":{"time_boot_ms":123456,"roll":0.1,"pitch":-0.2,"yaw":3,"rollspeed":0.01,"pitchspeed":0.02,)"
      R"("yawspeed":-0.03}})");
}

TEST(AppendFrame, ShowsThePayloadOfAnUnknownMessage) {
  EXPECT_EQ(line(bytes(testing::radio_status_frame), nullptr),
            R"({"time_us":1700000000000001,"id":109,"name":"unknown:109","version":2,"system":1,"component":1,)"
            R"("sequence":9,"payload":"00"})");
}

TEST(AppendFrame, WritesTextsAndTheExtensionsThatWereNotSent) {
  EXPECT_TRUE(line(bytes(testing::statustext_frame), &testing::Statustext::info)
                  .ends_with(R"("fields":{"severity":6,"text":"Init Gyro**","id":0,"chunk_seq":0}})"));
}

TEST(AppendFields, WritesListsAndKeepsWhatJsonNumbersCannot) {
  const testing::Everything message{.whole = std::numeric_limits<std::int64_t>::min(),
                                    .fine = -std::numeric_limits<double>::infinity(),
                                    .triple = {1, 2, 3},
                                    .tiny = -1,
                                    .letter = 'q'};
  std::array<std::byte, max_frame_size> out{};
  (void)encode(message, {}, out);
  JsonText json;
  append_fields(json, testing::Everything::info, parse_frame(out)->payload);
  EXPECT_EQ(json.text(),
            R"({"whole":"-9223372036854775808","fine":"-Infinity","triple":[1,2,3],"tiny":-1,"letter":"q"})");
}

TEST(AppendLabels, TellsWhatEnumerationsCallTheValues) {
  static constexpr std::array<EnumEntry, 2> entries{{{1, "LOW"}, {2, "HIGH"}}};
  static constexpr EnumInfo levels{"LEVELS", false, entries};
  static constexpr EnumInfo flags{"FLAGS", true, entries};
  static constexpr std::array<FieldInfo, 4> fields{{
      {"level", FieldType::uint8, 0, 0, false, "", "", &levels},
      {"flags", FieldType::int8, 0, 1, false, "", "", &flags},
      {"levels", FieldType::uint8, 2, 2, false, "", "", &levels},
      {"plain", FieldType::uint8, 0, 4, false, "", "", nullptr},
  }};
  static constexpr MessageInfo message{MessageId{1}, "LEVELS", 0, 5, 5, fields};
  const auto labels = [&](std::string_view payload) {
    JsonText json;
    json.begin_object();
    append_labels(json, message, bytes(payload));
    return json.end_object().text();
  };
  EXPECT_EQ(labels("02 03 00 01 02"), R"({"labels":{"level":"HIGH","flags":"LOW|HIGH","levels":["","LOW"]}})");
  EXPECT_EQ(labels("03 ff 00 00 02"), "{}") << "a negative number has no bits to name";
}

}  // namespace
}  // namespace ponte::mavlink
