#include "ponte/reflection/dialect_file.hpp"

#include "ponte/definitions/test_tools.hpp"
#include "ponte/mavlink/autopilots/dialect.hpp"
#include "ponte/mavlink/field_value.hpp"
#include "ponte/mavlink/parser.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>

namespace ponte::reflection {
namespace {

using definitions::refusal_of;

constexpr std::string_view own_dialect = R"(<mavlink>
  <enums>
    <enum name="LIGHT"><entry name="LIGHT_OFF" value="0"/><entry name="LIGHT_ON" value="1"/></enum>
  </enums>
  <messages>
    <message id="60001" name="LAMP">
      <field type="uint8_t" name="state" enum="LIGHT">On or off</field>
      <field type="float" name="temperature" units="degC" invalid="NaN">Of the lamp</field>
      <field type="uint16_t[3]" name="colour" instance="true">Red, green, blue</field>
      <extensions/>
      <field type="char[8]" name="label">Words</field>
    </message>
  </messages>
</mavlink>)";

void expect_same(const mavlink::FieldInfo& read, const mavlink::FieldInfo& generated) {
  EXPECT_EQ(read.name, generated.name);
  EXPECT_EQ(read.type, generated.type);
  EXPECT_EQ(read.array_length, generated.array_length);
  EXPECT_EQ(read.offset, generated.offset);
  EXPECT_EQ(read.extension, generated.extension);
  EXPECT_EQ(read.unit, generated.unit);
  EXPECT_EQ(read.invalid, generated.invalid);
  EXPECT_EQ(read.instance, generated.instance);
  ASSERT_EQ(read.enumeration == nullptr, generated.enumeration == nullptr);
  if (read.enumeration == nullptr) return;
  EXPECT_EQ(read.enumeration->name, generated.enumeration->name);
  EXPECT_EQ(read.enumeration->bitmask, generated.enumeration->bitmask);
  EXPECT_TRUE(std::ranges::equal(read.enumeration->entries, generated.enumeration->entries,
                                 [](auto& a, auto& b) { return a.value == b.value && a.name == b.name; }));
}

TEST(LoadDialect, GivesTheTablesOfTheGeneratedDialect) {
  const auto file = load_dialect(PONTE_SOURCE_DIR "/definitions/mavlink/autopilots.xml", {PONTE_MAVLINK_XML_DIR});
  const auto& generated = mavlink::autopilots::dialect;
  EXPECT_EQ(file.dialect().name, generated.name);
  ASSERT_EQ(file.dialect().messages.size(), generated.messages.size());
  for (std::size_t i = 0; i < generated.messages.size(); ++i) {
    const auto& read = *file.dialect().messages[i];
    const auto& wanted = *generated.messages[i];
    SCOPED_TRACE(wanted.name);
    EXPECT_EQ(read.id, wanted.id);
    EXPECT_EQ(read.name, wanted.name);
    EXPECT_EQ(read.crc_extra, wanted.crc_extra);
    EXPECT_EQ(read.base_length, wanted.base_length);
    EXPECT_EQ(read.full_length, wanted.full_length);
    ASSERT_EQ(read.fields.size(), wanted.fields.size());
    for (std::size_t field = 0; field < wanted.fields.size(); ++field)
      expect_same(read.fields[field], wanted.fields[field]);
  }
}

TEST(ParseDialect, LetsAnyFieldBeWrittenAndReadByName) {
  const auto file = parse_dialect(own_dialect, "lamps.xml");
  const auto* lamp = file.dialect().find("LAMP");
  ASSERT_NE(lamp, nullptr);
  EXPECT_EQ(lamp->find("temperature")->unit, "degC");
  EXPECT_EQ(lamp->find("temperature")->invalid, "NaN");

  std::array<std::byte, mavlink::max_frame_size> payload{};
  const auto& state = *lamp->find("state");
  ASSERT_TRUE(mavlink::write_element(state, payload, 0, *mavlink::value_of(*state.enumeration, "LIGHT_ON")));
  ASSERT_TRUE(mavlink::write_element(*lamp->find("colour"), payload, 2, std::uint64_t{500}));
  ASSERT_TRUE(mavlink::write_text(*lamp->find("label"), payload, "bow"));

  struct Sink final : mavlink::FrameSink {
    void on_frame(const mavlink::FrameView& frame, const mavlink::MessageInfo* message) override {
      ASSERT_NE(message, nullptr);
      const auto fields = readable_payload(frame, *message);
      EXPECT_EQ(mavlink::read_element(*message->find("state"), fields), mavlink::FieldValue{std::uint64_t{1}});
      EXPECT_EQ(mavlink::read_element(*message->find("colour"), fields, 2), mavlink::FieldValue{std::uint64_t{500}});
      EXPECT_EQ(mavlink::read_text(*message->find("label"), fields), "bow");
      ++frames;
    }
    int frames{};
  } sink;
  std::array<std::byte, mavlink::max_frame_size> frame{};
  const auto size = mavlink::write_frame({}, *lamp, Bytes{payload}.first(lamp->full_length), frame);
  mavlink::Parser parser{file.dialect()};
  parser.on_datagram(Bytes{frame}.first(*size), sink);
  EXPECT_EQ(sink.frames, 1);
}

TEST(ParseDialect, KeepsItsTablesInPlaceWhenItIsMoved) {
  auto first = parse_dialect(own_dialect, "lamps.xml");
  const auto* dialect = &first.dialect();
  const auto second = std::move(first);
  EXPECT_EQ(&second.dialect(), dialect);
  EXPECT_EQ(second.dialect().name, "lamps");
}

TEST(ParseDialect, RefusesWithFileLineAndReason) {
  const auto text = definitions::replaced(own_dialect, "uint8_t", "uint9_t");
  EXPECT_EQ(refusal_of([&] { return parse_dialect(text, "lamps.xml"); }),
            "lamps.xml:7: type 'uint9_t' of state is not a MAVLink type");
  EXPECT_EQ(refusal_of([] { return load_dialect("/nowhere/lamps.xml"); }), "/nowhere/lamps.xml: cannot be read");
}

TEST(MessagesOf, PrefersTheFirstDialectAndStaysInOrder) {
  const auto own = parse_dialect(definitions::replaced(own_dialect, "60001", "30"), "lamps.xml");
  const auto both = messages_of(own.dialect(), mavlink::autopilots::dialect);
  EXPECT_EQ(both.size(), mavlink::autopilots::dialect.messages.size());
  const mavlink::Dialect dialect{"both", both};
  EXPECT_EQ(dialect.find(mavlink::MessageId{30}), own.dialect().messages[0]);
  EXPECT_EQ(dialect.find(mavlink::MessageId{0}), mavlink::autopilots::dialect.messages[0]);
  EXPECT_TRUE(std::ranges::is_sorted(both, {}, [](const auto* message) { return message->id; }));
}

}  // namespace
}  // namespace ponte::reflection
