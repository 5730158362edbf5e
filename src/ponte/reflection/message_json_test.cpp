#include "ponte/reflection/message_json.hpp"

#include "ponte/core/random.hpp"
#include "ponte/definitions/test_tools.hpp"
#include "ponte/mavlink/autopilots/attitude.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/codec.hpp"
#include "ponte/mavlink/field_value.hpp"
#include "ponte/mavlink/json.hpp"
#include "ponte/mavlink/v09/dialect.hpp"
#include "ponte/reflection/dialect_file.hpp"
#include "support/seed.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ponte::reflection {
namespace {

using mavlink::FieldType;
const mavlink::Dialect dialect{"everything", mavlink::autopilots::dialect.messages, &mavlink::v09::dialect};

/// Every kind of field, and two enumerations.
const DialectFile test_file = parse_dialect(R"(<mavlink>
  <enums>
    <enum name="LIGHT"><entry name="LIGHT_OFF" value="0"/><entry name="LIGHT_ON" value="1"/></enum>
    <enum name="SIDES" bitmask="true"><entry name="PORT" value="1"/><entry name="STARBOARD" value="2"/></enum>
  </enums>
  <messages>
    <message id="300" name="LAMP">
      <field type="uint8_t" name="state" enum="LIGHT">.</field>
      <field type="uint16_t" name="sides" enum="SIDES">.</field>
      <field type="float" name="heat">.</field>
      <field type="int64_t" name="drift">.</field>
      <field type="uint64_t" name="serial">.</field>
      <field type="int8_t[2]" name="shift">.</field>
      <field type="char[4]" name="label">.</field>
      <extensions/>
      <field type="double" name="age">.</field>
    </message>
  </messages>
</mavlink>)",
                                            "lamps.xml");

constexpr std::string_view lamp =
    R"({"name":"LAMP","fields":{"state":1,"sides":3,"heat":0.5,"drift":-1,"serial":2,"shift":[1,-2],"label":"bow"}})";

Result<JsonMessage, JsonRefusal> read(std::string_view text) { return message_from_json(text, test_file.dialect()); }

/// `lamp` with one value changed.
std::string lamp_with(std::string_view old, std::string_view by) { return definitions::replaced(lamp, old, by); }

std::string refusal(std::string_view text) {
  const auto message = read(text);
  return message ? "(nothing was refused)" : to_text(message.error());
}

mavlink::FieldValue value_in(std::string_view text, std::string_view name) {
  const auto message = read(text);
  if (!message) throw std::invalid_argument{to_text(message.error())};
  return mavlink::read_element(*message->message->find(name), message->payload());
}

TEST(MessageFromJson, GivesATypedMessage) {
  const auto read = message_from_json(
      R"({"name":"ATTITUDE","version":1,"system":7,"component":8,"sequence":9,"fields":{"time_boot_ms":5,"roll":0.1,)"
      R"("pitch":"NaN","yaw":3,"rollspeed":-0.0,"pitchspeed":"-Infinity","yawspeed":1e-45}})",
      dialect);
  ASSERT_TRUE(read) << to_text(read.error());
  EXPECT_EQ(read->header.version, mavlink::Version::v1);
  EXPECT_EQ(read->header.system, mavlink::SystemId{7});
  EXPECT_EQ(read->header.component, mavlink::ComponentId{8});
  EXPECT_EQ(read->header.sequence, 9);
  const auto attitude = mavlink::decode<mavlink::autopilots::Attitude>(read->payload());
  EXPECT_EQ(attitude.time_boot_ms, 5U);
  EXPECT_EQ(attitude.roll, 0.1F);
  EXPECT_TRUE(std::isnan(attitude.pitch));
  EXPECT_TRUE(std::signbit(attitude.rollspeed));
  EXPECT_EQ(attitude.pitchspeed, -std::numeric_limits<float>::infinity());
  EXPECT_EQ(attitude.yawspeed, std::numeric_limits<float>::denorm_min());
}

TEST(MessageFromJson, TakesNamesOfEnumerations) {
  EXPECT_EQ(value_in(lamp_with("1", R"("LIGHT_ON")"), "state"), mavlink::FieldValue{std::uint64_t{1}});
  EXPECT_EQ(value_in(lamp_with("3", R"("PORT|STARBOARD|64")"), "sides"), mavlink::FieldValue{std::uint64_t{67}});
}

TEST(MessageFromJson, TakesDigitsThatNumbersCannotKeep) {
  EXPECT_EQ(value_in(lamp_with("-1", R"("-9223372036854775808")"), "drift"),
            mavlink::FieldValue{std::numeric_limits<std::int64_t>::min()});
  EXPECT_EQ(value_in(lamp_with("2,\"shift", R"("18446744073709551615","shift)"), "serial"),
            mavlink::FieldValue{std::numeric_limits<std::uint64_t>::max()});
  EXPECT_EQ(value_in(lamp_with("2,\"shift", R"(18446744073709551615,"shift)"), "serial"),
            mavlink::FieldValue{std::numeric_limits<std::uint64_t>::max()});
}

TEST(MessageFromJson, TakesMissingExtensionsForZero) {
  EXPECT_EQ(value_in(lamp, "age"), mavlink::FieldValue{0.0});
  EXPECT_EQ(value_in(lamp_with(R"("state")", R"("age":2.5,"state")"), "age"), mavlink::FieldValue{2.5});
}

TEST(MessageFromJson, FindsTheMessageByName) {
  EXPECT_TRUE(read(lamp_with(R"("name")", R"("id":300,"name")")));
  EXPECT_EQ(refusal(lamp_with(R"("name")", R"("id":301,"name")")), "id: it is 301; expected 300, or none, for LAMP");
  EXPECT_EQ(refusal(lamp_with("LAMP", "lamp")), R"(name: it is "lamp"; expected the name of a message of lamps)");
  EXPECT_EQ(refusal(R"({"fields":{}})"), "name: it is missing; expected the name of a message");
}

TEST(MessageFromJson, TakesMessagesOfVersion09WhereTheyAreAskedFor) {
  const auto v09 = parse_dialect(
      R"(<mavlink wire="0.9"><messages><message id="7" name="LAMP"><field type="uint16_t" name="state">.</field></message>
         </messages></mavlink>)",
      "old.xml");
  const mavlink::Dialect both{"both", test_file.dialect().messages, &v09.dialect()};
  const auto old = message_from_json(R"({"name":"LAMP","version":0.9,"fields":{"state":258}})", both);
  ASSERT_TRUE(old) << to_text(old.error());
  EXPECT_EQ(old->header.version, mavlink::Version::v0_9);
  EXPECT_EQ(old->payload()[0], std::byte{1}) << "big-endian";
  EXPECT_EQ(message_from_json(lamp, both)->header.version, mavlink::Version::v2);
  EXPECT_TRUE(message_from_json(R"({"name":"LAMP","fields":{"state":258}})", v09.dialect()));
  EXPECT_EQ(to_text(message_from_json(R"({"name":"LAMP","version":2,"fields":{"state":258}})", v09.dialect()).error()),
            "version: it is 2; expected 0.9");
}

TEST(MessageFromJson, RefusesAValueThatTheFieldCannotHold) {
  EXPECT_EQ(refusal(lamp_with("1", "256")),
            "fields.state: it is 256; expected an integer from 0 to 255, or a name of LIGHT");
  EXPECT_EQ(refusal(lamp_with("1", R"("LIGHT_DIM")")),
            R"(fields.state: it is "LIGHT_DIM"; expected an integer from 0 to 255, or a name of LIGHT)");
  EXPECT_EQ(refusal(lamp_with("1", "0.5")),
            "fields.state: it is 0.5; expected an integer from 0 to 255, or a name of LIGHT");
  EXPECT_EQ(refusal(lamp_with("3", R"("PORT|TOP")")),
            R"(fields.sides: it is "PORT|TOP"; expected an integer from 0 to 65535, or names of SIDES)");
  EXPECT_EQ(refusal(lamp_with("0.5", "1e39")),
            R"(fields.heat: it is 1e+39; expected a number of 32 bits, "NaN", "Infinity" or "-Infinity")");
  EXPECT_EQ(refusal(lamp_with("0.5", "null")),
            R"(fields.heat: it is null; expected a number of 32 bits, "NaN", "Infinity" or "-Infinity")");
  EXPECT_EQ(refusal(lamp_with("-1", R"("9223372036854775808")")),
            R"(fields.drift: it is "9223372036854775808"; expected an integer from -9223372036854775808 to )"
            "9223372036854775807");
  EXPECT_EQ(refusal(lamp_with("-2", "-129")), "fields.shift[1]: it is -129; expected an integer from -128 to 127");
  EXPECT_EQ(refusal(lamp_with("[1,-2]", "[1]")), "fields.shift: it is a list of 1 values; expected a list of 2 values");
  EXPECT_EQ(refusal(lamp_with("bow", "stern")), R"(fields.label: it is "stern"; expected a text of at most 4 bytes)");
  EXPECT_EQ(refusal(lamp_with(R"("bow")", "7")), "fields.label: it is 7; expected a text of at most 4 bytes");
}

TEST(MessageFromJson, RefusesFieldsAndMembersThatAreMissingTooManyOrTwice) {
  EXPECT_EQ(refusal(lamp_with(R"("heat":0.5,)", "")),
            R"(fields.heat: it is missing; expected a number of 32 bits, "NaN", "Infinity" or "-Infinity")");
  EXPECT_EQ(
      refusal(lamp_with(R"("heat")", R"("cold":1,"heat")")),
      "fields.cold: it is no field of LAMP; expected one of state, sides, heat, drift, serial, shift, label, age");
  EXPECT_EQ(
      refusal(lamp_with(R"("name")", R"("nom":1,"name")")),
      "nom: it is no member of a message; expected one of time_us, id, name, version, system, component, sequence, "
      "fields, labels");
  EXPECT_EQ(refusal(lamp_with(R"("heat")", R"("state":1,"heat")")),
            R"(it is an object with "state" twice; expected each name once)");
  EXPECT_EQ(refusal(lamp_with(R"("name")", R"("system":256,"name")")),
            "system: it is 256; expected an integer from 0 to 255");
  EXPECT_EQ(refusal(lamp_with(R"("name")", R"("version":3,"name")")), "version: it is 3; expected 1 or 2");
}

TEST(MessageFromJson, RefusesWhatIsNoObject) {
  EXPECT_EQ(refusal("[1]"), "it is a list of 1 values; expected a JSON object");
  EXPECT_EQ(refusal(R"({"name":"LAMP"})"), "fields: it is missing; expected the fields of LAMP");
  EXPECT_EQ(refusal(R"({"name":"LAMP","fields":3})"), "fields: it is 3; expected an object with the fields of LAMP");
  EXPECT_NE(refusal("{\"name\"").find("line 1, column"), std::string::npos) << refusal("{\"name\"");
  EXPECT_NE(refusal(lamp_with("0.5", "1e999")).find("expected a JSON object"), std::string::npos);
  EXPECT_NE(refusal(std::string(100'000, '[')).find("expected a JSON object"), std::string::npos);
}

/// What JSON cannot say made plain: a NaN has no further bits, a text is printable and ends with NULs.
void make_plain(const mavlink::MessageInfo& message, MutableBytes payload) {
  for (const auto& field : message.fields) {
    if (field.type == FieldType::character) {
      bool ended = false;
      for (auto& byte : payload.subspan(field.offset, field.size())) {
        byte &= std::byte{0x7F};
        ended |= byte == std::byte{0};
        if (ended) byte = std::byte{0};
      }
    } else if (field.type == FieldType::float32 || field.type == FieldType::float64) {
      for (std::size_t i = 0; i < mavlink::element_count(field); ++i) {
        const auto is_nan =
            std::visit([](auto value) { return value != value; }, mavlink::read_element(field, payload, i));
        if (is_nan) (void)mavlink::write_element(field, payload, i, std::numeric_limits<double>::quiet_NaN());
      }
    }
  }
}

void expect_same_after_json(const mavlink::MessageInfo& message, std::vector<std::byte> payload) {
  make_plain(message, payload);
  std::array<std::byte, mavlink::max_frame_size> frame{};
  const auto version = message.is_v09() ? mavlink::Version::v0_9 : mavlink::Version::v2;
  const auto size = mavlink::write_frame({.version = version, .system = mavlink::SystemId{3}, .sequence = 200}, message,
                                         payload, frame);
  JsonText json;
  mavlink::append_frame(json, {}, *mavlink::parse_frame(Bytes{frame}.first(*size)), &message);
  const auto back = message_from_json(json.text(), dialect);
  ASSERT_TRUE(back) << json.text() << to_text(back.error());
  EXPECT_EQ(back->message, &message);
  EXPECT_EQ(back->header.sequence, 200);
  EXPECT_TRUE(std::ranges::equal(back->payload(), payload)) << json.text();
}

TEST(MessageFromJson, ReadsEveryMessageThatWasWrittenSeeded) {
  const auto seed = chosen_seed();
  SCOPED_TRACE(seed);
  Random random{seed};
  auto messages = std::vector(dialect.messages.begin(), dialect.messages.end());
  messages.insert(messages.end(), dialect.v09->messages.begin(), dialect.v09->messages.end());
  for (const auto* message : messages) {
    SCOPED_TRACE(message->name);
    for (const auto byte : {std::byte{0}, std::byte{0x7F}, std::byte{0x80}, std::byte{0xFF}})
      expect_same_after_json(*message, std::vector<std::byte>(message->full_length, byte));
    for (int round = 0; round < 20; ++round) {
      std::vector<std::byte> payload(message->full_length);
      random.fill(payload);
      expect_same_after_json(*message, payload);
    }
  }
}

}  // namespace
}  // namespace ponte::reflection
