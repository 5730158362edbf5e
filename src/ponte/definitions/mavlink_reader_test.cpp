#include "ponte/definitions/mavlink_reader.hpp"

#include "ponte/definitions/test_tools.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace ponte::definitions {
namespace {

using testing::ElementsAre;

/// The package's messages with ours, as the programs use them.
const Protocol& autopilots() {
  static const auto protocol = read_mavlink(PONTE_SOURCE_DIR "/definitions/mavlink/autopilots.xml",
                                            {PONTE_SOURCE_DIR "/definitions/mavlink", PONTE_MAVLINK_XML_DIR});
  return protocol;
}

Protocol read(std::string_view body) {
  return read_mavlink_text(fmt::format("<mavlink>{}</mavlink>", body), "test.xml");
}

struct Wire {
  std::uint32_t id;
  std::string_view name;
  int crc_extra;
  std::size_t base_length;
  std::size_t full_length;
};

// From the C headers that MAVLink publishes, which another program generates.
constexpr Wire published[] = {
    {0, "HEARTBEAT", 50, 9, 9},        {1, "SYS_STATUS", 124, 31, 43},           {24, "GPS_RAW_INT", 24, 30, 52},
    {30, "ATTITUDE", 39, 28, 28},      {33, "GLOBAL_POSITION_INT", 104, 28, 28}, {73, "MISSION_ITEM_INT", 38, 37, 38},
    {76, "COMMAND_LONG", 152, 33, 33}, {77, "COMMAND_ACK", 143, 3, 10},          {147, "BATTERY_STATUS", 154, 36, 54},
    {253, "STATUSTEXT", 83, 51, 54},
};

TEST(MavlinkReader, AgreesWithThePublishedChecksumSeedsAndLengths) {
  for (const auto& expected : published) {
    const auto& message = message_of(autopilots(), expected.id);
    EXPECT_EQ(message.name, expected.name);
    EXPECT_EQ(message.crc_extra, expected.crc_extra) << expected.name;
    EXPECT_EQ(message.base_length, expected.base_length) << expected.name;
    EXPECT_EQ(message.full_length, expected.full_length) << expected.name;
  }
}

TEST(MavlinkReader, Mavlink09KeepsTheOrderAndHasNoChecksumSeed) {
  const auto protocol = read_mavlink_text(
      "<mavlink wire='0.9'><messages>"
      "<message id='9' name='LONG'><field type='uint8_t_mavlink_version' name='v'/><field type='float' "
      "name='x'/></message>"
      "<message id='9' name='SHORT'><field type='int16_t' name='y'/></message>"
      "</messages></mavlink>",
      "test.xml");
  EXPECT_TRUE(protocol.v09);
  ASSERT_EQ(protocol.messages.size(), 2U);
  EXPECT_EQ(protocol.messages[0].name, "SHORT") << "by length";
  const auto& message = protocol.messages[1];
  EXPECT_EQ(message.crc_extra, 0);
  EXPECT_EQ(message.fields[0].offset, 0U);
  EXPECT_EQ(message.fields[0].initial, "2");
  EXPECT_EQ(message.fields[1].offset, 1U);
}

TEST(MavlinkReader, PutsWideFieldsFirstAndExtensionsLastUnsorted) {
  const auto& battery = message_of(autopilots(), 147);
  EXPECT_EQ(battery.fields.front().name, "id");  // as defined, not as sent
  EXPECT_EQ(field_of(battery, "current_consumed").offset, 0U);
  EXPECT_EQ(field_of(battery, "temperature").offset, 8U);
  EXPECT_EQ(field_of(battery, "voltages").offset, 10U);
  EXPECT_EQ(field_of(battery, "id").offset, 32U);
  EXPECT_EQ(field_of(battery, "battery_remaining").offset, 35U);
  EXPECT_EQ(field_of(battery, "time_remaining").offset, 36U);
  EXPECT_EQ(field_of(battery, "charge_state").offset, 40U);
  EXPECT_EQ(field_of(battery, "voltages_ext").offset, 41U);
  EXPECT_EQ(field_of(battery, "fault_bitmask").offset, 50U);
  EXPECT_FALSE(field_of(battery, "battery_remaining").extension);
  EXPECT_TRUE(field_of(battery, "time_remaining").extension);
}

TEST(MavlinkReader, KeepsTheOrderOfFieldsOfOneWidth) {
  const auto protocol = read(
      "<messages><message id='1' name='A'><field type='uint8_t' name='a'/>"
      "<field type='uint16_t[2]' name='b'/><field type='char[3]' name='c'/>"
      "<field type='int16_t' name='d'/></message></messages>");
  EXPECT_THAT(wire_order(protocol.messages.at(0)), ElementsAre(1, 3, 0, 2));
}

TEST(MavlinkReader, StartsTheProtocolVersionAtThree) {
  EXPECT_EQ(field_of(message_of(autopilots(), 0), "mavlink_version").initial, "3");
  EXPECT_EQ(field_of(message_of(autopilots(), 0), "type").initial, "");
}

TEST(MavlinkReader, ReadsEveryAttributeOfAField) {
  const auto protocol = read(
      "<enums><enum name='E'><entry name='E_A' value='1'/></enum></enums>"
      "<messages><message id='0x10' name='A'><description>two\n  lines</description>"
      "<field type='uint16_t[7]' name='default' units='mV' invalid='UINT16_MAX' enum='E' instance='true'>why"
      "</field></message></messages>");
  const auto& message = message_of(protocol, 16);
  EXPECT_EQ(message.note, "two lines");
  const auto& field = message.fields.at(0);
  EXPECT_EQ(field.name, "default");
  EXPECT_EQ(field.key, "default_");
  EXPECT_EQ(field.kind, Kind::unsigned_integer);
  EXPECT_EQ(field.width, 2U);
  EXPECT_EQ(field.count, 7U);
  EXPECT_EQ(field.size(), 14U);
  EXPECT_EQ(field.unit, "mV");
  EXPECT_EQ(field.invalid, "UINT16_MAX");
  EXPECT_EQ(field.enumeration, "E");
  EXPECT_EQ(field.note, "why");
  EXPECT_TRUE(field.instance);
}

TEST(MavlinkReader, SaysWhereAMessageStands) {
  const auto protocol =
      read("\n<messages>\n\n<message id='1' name='A'>\n<field type='float' name='x'/></message></messages>");
  EXPECT_EQ(protocol.messages.at(0).source.file, "test.xml");
  EXPECT_EQ(protocol.messages.at(0).source.line, 4U);
  EXPECT_EQ(protocol.messages.at(0).fields.at(0).source.line, 5U);
}

TEST(MavlinkReader, ReadsEverySectionOfAFile) {
  const auto protocol = read(
      "<messages><message id='2' name='B'><field type='float' name='x'/></message></messages>"
      "<messages><message id='1' name='A'><field type='float' name='x'/></message></messages>");
  EXPECT_EQ(protocol.messages.at(0).name, "A");
  EXPECT_EQ(protocol.messages.at(1).name, "B");
}

TEST(MavlinkReader, CountsOnFromTheLastValueAndReadsEveryNotation) {
  const auto protocol = read(
      "<enums><enum name='E'><entry name='E_A'/><entry name='E_B'/><entry name='E_C' value='0x10'/>"
      "<entry name='E_D'/><entry name='E_E' value='0b11'/><entry name='E_F' value='2**63'/>"
      "</enum></enums>");
  std::vector<std::pair<std::string, std::uint64_t>> values;
  for (const auto& entry : protocol.enumerations.at(0).entries) values.emplace_back(entry.name, entry.first);
  EXPECT_THAT(values, ElementsAre(std::pair{"E_A", 0U}, std::pair{"E_B", 1U}, std::pair{"E_E", 3U},
                                  std::pair{"E_C", 16U}, std::pair{"E_D", 17U}, std::pair{"E_F", 1ULL << 63U}));
}

TEST(MavlinkReader, MarksABitmaskWhetherTheEnumOrAFieldSaysSo) {
  const auto protocol = read(
      "<enums><enum name='A' bitmask='true'><entry name='A_1' value='1'/></enum>"
      "<enum name='B'><entry name='B_1' value='1'/></enum>"
      "<enum name='C'><entry name='C_1' value='1'/></enum></enums><messages>"
      "<message id='1' name='M'><field type='uint8_t' name='b' enum='B' display='bitmask'/>"
      "<field type='uint8_t' name='c' enum='C'/></message></messages>");
  EXPECT_TRUE(protocol.find_enumeration("A")->bitmap);
  EXPECT_TRUE(protocol.find_enumeration("B")->bitmap);
  EXPECT_FALSE(protocol.find_enumeration("C")->bitmap);
}

constexpr std::string_view base_and_extension =
    "<messages><message id='1' name='A' extend='true'><field type='uint32_t' name='added'/></message>"
    "<message id='1' name='A'><field type='uint8_t' name='x'/></message></messages>";

TEST(MavlinkReader, AppendsAnExtensionWithoutChangingTheSeed) {
  const auto plain =
      read("<messages><message id='1' name='A'><field type='uint8_t' name='x'/></message></messages>").messages.at(0);
  const auto extended = read(base_and_extension).messages.at(0);
  EXPECT_EQ(extended.crc_extra, plain.crc_extra);
  EXPECT_EQ(extended.base_length, 1U);
  EXPECT_EQ(extended.full_length, 5U);
  EXPECT_TRUE(field_of(extended, "added").extension);
  EXPECT_EQ(field_of(extended, "added").offset, 1U);
}

TEST(MavlinkReader, PassesOverAnExtensionThatANewerPackageHasAlready) {
  const auto message = read(replaced(base_and_extension, "<field type='uint8_t' name='x'/>",
                                     "<field type='uint8_t' name='x'/><extensions/>"
                                     "<field type='uint32_t' name='added'/>"))
                           .messages.at(0);
  EXPECT_EQ(message.fields.size(), 2U);
  EXPECT_EQ(message.full_length, 5U);
}

TEST(MavlinkReader, NamesTheDialectAfterTheFile) {
  EXPECT_EQ(read_mavlink_text("<mavlink/>", "some/My-Dialect.xml").name, "my_dialect");
}

}  // namespace
}  // namespace ponte::definitions
