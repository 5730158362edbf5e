#include "ponte/dli/codec.hpp"

#include "ponte/dli/messages/all.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/dli/walk.hpp"
#include "ponte/dli/worked_examples.hpp"
#include "support/bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace ponte::dli {
namespace {

using namespace worked_examples;
using ::testing::ElementsAre;
using ::testing::Pair;

const Profile ed3{Edition::ed3};
const Profile ed_a{Edition::ed_a};

messages::InertialStates attitude() {
  messages::InertialStates message;
  message.time_stamp = 508766400000;
  message.roll = 1820;
  message.pitch = -910;
  message.heading = 16384;
  message.roll_rate = 20;
  message.pitch_rate = -10;
  message.turn_rate = 4;
  return message;
}

messages::InertialStates all_fields() {
  auto message = attitude();
  message.latitude = 461975034;
  message.longitude = -109036096;
  message.altitude = 6025;
  message.altitude_type = 3;
  message.u_speed = 246;
  message.v_speed = -90;
  message.w_speed = -20;
  message.u_accel = 0;
  message.v_accel = 0;
  message.w_accel = 0;
  message.magnetic_variation = -455;
  return message;
}

Bytes data_of(const std::vector<std::byte>& datagram) { return parse_message(datagram, ed3).value().data; }

template <class M>
std::vector<std::byte> encoded(const M& message, const Profile& profile) {
  std::vector<std::byte> out(data_size_max);
  out.resize(encode(message, profile, out).value());
  return out;
}

/// The raw values of the present integer fields, by number.
std::map<int, std::int64_t> walked(const MessageInfo& info, Bytes data, const Profile& profile) {
  std::map<int, std::int64_t> values;
  const auto facts = walk(info, data, profile, [&](const FieldInfo& field, Bytes bytes) {
    if (is_integer(field.type)) values[field.number] = raw_integer(field, bytes);
  });
  EXPECT_TRUE(facts);
  return values;
}

TEST(Decode, ReadsTheWorkedExamples) {
  for (const auto example : {attitude_without_checksum, attitude_with_sum16, attitude_with_sum32})
    EXPECT_EQ(decode<messages::InertialStates>(data_of(bytes(example)), ed3), attitude());
  EXPECT_EQ(decode<messages::InertialStates>(data_of(bytes(all_fields_with_sum16)), ed3), all_fields());
}

TEST(AddMessage, WritesTheWorkedExamples) {
  const auto write = [](const messages::InertialStates& message, Checksum checksum) {
    const auto profile = profile_with(checksum);
    std::vector<std::byte> buffer(100);
    DatagramWriter writer{buffer, profile};
    EXPECT_TRUE(add_message(writer, envelope, message));
    return std::vector(writer.bytes().begin(), writer.bytes().end());
  };
  EXPECT_EQ(write(attitude(), Checksum::none), bytes(attitude_without_checksum));
  EXPECT_EQ(write(attitude(), Checksum::sum16), bytes(attitude_with_sum16));
  EXPECT_EQ(write(attitude(), Checksum::sum32), bytes(attitude_with_sum32));
  EXPECT_EQ(write(all_fields(), Checksum::sum16), bytes(all_fields_with_sum16));
}

TEST(AddMessage, LeavesTheDatagramAloneWhenTheMessageDoesNotFit) {
  std::vector<std::byte> buffer(70);
  DatagramWriter writer{buffer, ed3};
  ASSERT_TRUE(add_message(writer, envelope, attitude()));
  EXPECT_EQ(add_message(writer, envelope, attitude()).error().reason, EncodeError::Reason::no_room);
  EXPECT_EQ(std::vector(writer.bytes().begin(), writer.bytes().end()), bytes(attitude_with_sum16));
  writer.clear();
  EXPECT_TRUE(add_message(writer, envelope, attitude()));
}

TEST(Decode, NamesTheFieldAtWhichShorterDataEnd) {
  const auto datagram = bytes(all_fields_with_sum16);
  const auto data = data_of(datagram);
  std::size_t field_end = 3;
  std::size_t size = 0;
  for (; size < field_end; ++size)
    EXPECT_EQ(decode<messages::InertialStates>(data.first(size), ed3),
              fail(DecodeError{DecodeError::Reason::truncated_vector, 0}));
  for (const auto& field : messages::InertialStates::fields) {
    field_end += field.width;
    for (; size < field_end; ++size)
      EXPECT_EQ(decode<messages::InertialStates>(data.first(size), ed3),
                fail(DecodeError{DecodeError::Reason::truncated_field, field.number}))
          << "at " << size;
  }
  EXPECT_EQ(size, data.size());
}

TEST(Decode, RefusesBytesBehindTheLastField) {
  auto data = encoded(attitude(), ed3);
  data.push_back(std::byte{0});
  EXPECT_EQ(decode<messages::InertialStates>(data, ed3),
            fail(DecodeError{DecodeError::Reason::bytes_after_last_field, 0}));
}

TEST(Decode, TakesAMessageWithoutAnyField) {
  EXPECT_EQ(decode<messages::InertialStates>(bytes("00 00 00"), ed3), messages::InertialStates{});
  EXPECT_EQ(encoded(messages::InertialStates{}, ed3), bytes("00 00 00"));
}

TEST(Decode, ReadsTheKnownFieldsBeforeTheFirstNewerOne) {
  // Bit 18 of #4000 belongs to no field; what follows field 12 cannot be told apart from it, nor counted.
  const auto data = bytes("04 08 01 76 74 D7 2E 00 07 1C AA BB CC");
  DecodeFacts facts;
  const auto message = decode<messages::InertialStates>(data, ed3, &facts);
  ASSERT_TRUE(message);
  EXPECT_TRUE(facts.newer_fields);
  EXPECT_EQ(message->roll, 1820);
  EXPECT_EQ(decode<messages::InertialStates>(bytes("04 00 00"), ed3, &facts), messages::InertialStates{});
  EXPECT_TRUE(facts.newer_fields);
  EXPECT_TRUE(decode<messages::InertialStates>(encoded(attitude(), ed3), ed3, &facts));
  EXPECT_FALSE(facts.newer_fields);
}

messages::VehicleOperatingStates operating_states_of_edition_a() {
  messages::VehicleOperatingStates message;
  message.time_stamp = 9;
  message.commanded_altitude = -8388608;
  message.thrust = 100;
  message.commanded_loiter_position_latitude = -2147483647 - 1;
  message.commanded_waypoint_number = 65535;
  return message;
}

TEST(Editions, FieldsOfEditionAAreNotSentInEdition3) {
  const auto message = operating_states_of_edition_a();
  EXPECT_EQ(encoded(message, ed_a), bytes("94 00 03 00 00 00 00 09 80 00 00 64 80 00 00 00 FF FF"));
  EXPECT_EQ(encoded(message, ed3), bytes("04 00 03 00 00 00 00 09 80 00 00 64"));
  EXPECT_EQ(decode<messages::VehicleOperatingStates>(encoded(message, ed_a), ed_a), message);
}

TEST(Editions, FieldsOfEditionAAreUnknownInEdition3) {
  const auto data = encoded(operating_states_of_edition_a(), ed_a);
  auto expected = operating_states_of_edition_a();
  expected.commanded_loiter_position_latitude.reset();
  expected.commanded_waypoint_number.reset();
  DecodeFacts facts;
  EXPECT_EQ(decode<messages::VehicleOperatingStates>(data, ed3, &facts), expected);
  EXPECT_TRUE(facts.newer_fields);
}

TEST(Editions, AMessageOfTheOtherEditionIsRefused) {
  const auto refused = fail(DecodeError{DecodeError::Reason::not_in_edition, 0});
  const auto data = bytes("00 01 00 00 00 00 05");
  EXPECT_TRUE(decode<messages::PositiveHandoverAuthorisationRequest>(data, ed_a));
  EXPECT_EQ(decode<messages::PositiveHandoverAuthorisationRequest>(data, ed3), refused);
  std::vector<std::byte> out(100);
  EXPECT_EQ(encode(messages::PositiveHandoverAuthorisationRequest{}, ed3, out),
            fail(EncodeError{EncodeError::Reason::not_in_edition, 0}));
  EXPECT_EQ(encode(messages::ModePreferenceReport{}, ed_a, out),
            fail(EncodeError{EncodeError::Reason::not_in_edition, 0}));
}

TEST(Editions, TheVectorHasTheWidthOfTheEdition) {
  messages::SubsystemStatusAlert alert;
  alert.time_stamp = 1;
  alert.append_order = 2;
  EXPECT_EQ(encoded(alert, ed3), bytes("00 01 00 00 00 00 01"));
  EXPECT_EQ(encoded(alert, ed_a), bytes("00 80 01 00 00 00 00 01 02"));
}

TEST(Profiles, CanOverrideTheWidthOfAVector) {
  auto profile = ed3;
  profile.override_presence_bytes(MessageNumber{3007}, 1);
  messages::EngineOperatingStates message;
  message.time_stamp = 1;
  message.engine_number = 2;
  EXPECT_EQ(encoded(message, ed3), bytes("00 00 00 00 03 00 00 00 00 01 00 02"));
  EXPECT_EQ(encoded(message, profile), bytes("03 00 00 00 00 01 00 02"));
  EXPECT_EQ(decode<messages::EngineOperatingStates>(encoded(message, profile), profile), message);

  // A field that the narrower vector has no bit for is not sent.
  auto narrowed = operating_states_of_edition_a();
  auto narrow = ed_a;
  narrow.override_presence_bytes(MessageNumber{3002}, 1);
  EXPECT_EQ(encoded(narrowed, narrow), bytes("03 00 00 00 00 09 80 00 00"));

  auto wide = ed3;
  wide.override_presence_bytes(MessageNumber{16002}, 8);
  messages::HeartbeatMessage heartbeat;
  heartbeat.time_stamp = 0xFFFFFFFFFF;
  EXPECT_EQ(encoded(heartbeat, wide), bytes("00 00 00 00 00 00 00 01 FF FF FF FF FF"));
  DecodeFacts facts;
  EXPECT_EQ(decode<messages::HeartbeatMessage>(bytes("80 00 00 00 00 00 00 01 FF FF FF FF FF 00"), wide, &facts),
            heartbeat);
  EXPECT_TRUE(facts.newer_fields);
}

TEST(ExcludedFields, AreSteppedOver) {
  // Fields 1, 10, 11 to 14 (out of scope, 1 + 1 + 2 + 1 bytes) and 15.
  const auto data = bytes("7E 01 00 00 00 00 05 0A B1 B2 B3 B3 B4 0F");
  const auto message = decode<messages::EoIrLaserPayloadCommand>(data, ed3);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->time_stamp, 5U);
  EXPECT_EQ(message->set_eo_ir_pointing_mode, 10);
  EXPECT_EQ(message->preplan_mode, 15);
  EXPECT_EQ(encoded(*message, ed3), bytes("42 01 00 00 00 00 05 0A 0F"));
  EXPECT_THAT(walked(messages::EoIrLaserPayloadCommand::info, data, ed3),
              ElementsAre(Pair(1, 5), Pair(10, 10), Pair(15, 15)));
  EXPECT_EQ(decode<messages::EoIrLaserPayloadCommand>(Bytes{data}.first(11), ed3),
            fail(DecodeError{DecodeError::Reason::truncated_field, 13}));
}

TEST(VariableText, HasTheLengthThatItsLengthFieldTells) {
  messages::AvUaIpDisclosureMessage message;
  message.time_stamp = 5;
  message.length_of_url = 9;
  message.uniform_resource_identifier.emplace("rtsp://a/");
  message.controlled_station_17_32 = 258;
  const auto data = encoded(message, ed3);
  EXPECT_EQ(data, bytes("01 C1 00 00 00 00 05 09 72 74 73 70 3A 2F 2F 61 2F 01 02"));
  EXPECT_EQ(decode<messages::AvUaIpDisclosureMessage>(data, ed3), message);

  message.length_of_url = 11;  // NULs behind the text
  EXPECT_EQ(decode<messages::AvUaIpDisclosureMessage>(encoded(message, ed3), ed3), message);
  message.length_of_url = 0;
  message.uniform_resource_identifier.emplace("");
  EXPECT_EQ(encoded(message, ed3), bytes("01 C1 00 00 00 00 05 00 01 02"));
  EXPECT_EQ(decode<messages::AvUaIpDisclosureMessage>(encoded(message, ed3), ed3), message);
  message.length_of_url = 255;
  message.uniform_resource_identifier.emplace(std::string(255, 'u'));
  EXPECT_EQ(decode<messages::AvUaIpDisclosureMessage>(encoded(message, ed3), ed3), message);
}

TEST(VariableText, IsRefusedWithoutItsLength) {
  EXPECT_EQ(decode<messages::AvUaIpDisclosureMessage>(bytes("00 81 00 00 00 00 05 61"), ed3),
            fail(DecodeError{DecodeError::Reason::text_without_length, 8}));
  EXPECT_EQ(decode<messages::AvUaIpDisclosureMessage>(bytes("00 C1 00 00 00 00 05 02 61"), ed3),
            fail(DecodeError{DecodeError::Reason::truncated_field, 8}));
  messages::AvUaIpDisclosureMessage message;
  message.uniform_resource_identifier.emplace("ab");
  std::vector<std::byte> out(100);
  EXPECT_EQ(encode(message, ed3, out), fail(EncodeError{EncodeError::Reason::text_without_length, 8}));
  message.length_of_url = 1;
  EXPECT_EQ(encode(message, ed3, out), fail(EncodeError{EncodeError::Reason::text_longer_than_its_length, 8}));
}

TEST(VariableText, OfMoreThan255BytesIsRefused) {
  constexpr std::array<FieldInfo, 2> fields{{
      {1, "length", "Length", "", FieldType::unsigned_integer, 2, 0, Role::value, 0, "", nullptr, false, false, false},
      {2, "text", "Text", "", FieldType::variable_text, 0, 1, Role::value, 0, "", nullptr, false, false, false},
  }};
  const MessageInfo info{MessageNumber{50001}, "test", "Test", "Test", {{1, 1}}, {{true, true}}, Confidence::unknown,
                         Confidence::unknown,  false,  fields};
  std::vector<std::byte> data(300, std::byte{'x'});
  data[0] = std::byte{3};
  store_be(&data[1], std::uint16_t{256});
  const auto ignore = [](const FieldInfo&, Bytes) {};
  EXPECT_EQ(walk(info, data, ed3, ignore), fail(DecodeError{DecodeError::Reason::text_too_long, 2}));
  store_be(&data[1], std::uint16_t{255});
  EXPECT_TRUE(walk(info, Bytes{data}.first(3 + 255), ed3, ignore));
}

TEST(FixedText, IsPaddedAndAlwaysEndsInNul) {
  messages::VehicleId message;
  message.tail_number.emplace("N123");
  const auto data = encoded(message, ed3);
  EXPECT_EQ(data, bytes("00 40 4E 31 32 33 00 00 00 00 00 00 00 00 00 00 00 00"));
  EXPECT_EQ(decode<messages::VehicleId>(data, ed3), message);

  message.tail_number.emplace("0123456789ABCDEF");
  EXPECT_EQ(decode<messages::VehicleId>(encoded(message, ed3), ed3)->tail_number->view(), "0123456789ABCDE");
}

TEST(FixedText, KeepsEveryReceivedByte) {
  const auto data = bytes("00 40 41 00 FF 42 43 44 45 46 47 48 49 4A 4B 4C 4D 4E");
  const auto message = decode<messages::VehicleId>(data, ed3);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->tail_number->view(), "A");
  EXPECT_EQ(message->tail_number->chars()[15], 'N');
}

TEST(Encode, RefusesARawValueThatItsFieldCannotHold) {
  std::vector<std::byte> out(100);
  messages::InertialStates message;
  message.altitude = 8388607;
  EXPECT_TRUE(encode(message, ed3, out));
  message.altitude = 8388608;
  EXPECT_EQ(encode(message, ed3, out), fail(EncodeError{EncodeError::Reason::value_too_wide, 4}));
  message.altitude = -8388609;
  EXPECT_EQ(encode(message, ed3, out), fail(EncodeError{EncodeError::Reason::value_too_wide, 4}));
  message.altitude.reset();
  message.time_stamp = std::uint64_t{1} << 40U;
  EXPECT_EQ(encode(message, ed3, out), fail(EncodeError{EncodeError::Reason::value_too_wide, 1}));
  message.time_stamp = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(encode(message, ed3, out), fail(EncodeError{EncodeError::Reason::value_too_wide, 1}));
}

TEST(Encode, NeedsRoomForEveryByte) {
  const auto expected = encoded(all_fields(), ed3);
  std::vector<std::byte> out(expected.size());
  for (std::size_t size = 0; size < expected.size(); ++size) {
    const auto written = encode(all_fields(), ed3, MutableBytes{out}.first(size));
    ASSERT_FALSE(written) << "at " << size;
    EXPECT_EQ(written.error().reason, EncodeError::Reason::no_room) << "at " << size;
  }
  EXPECT_EQ(encode(all_fields(), ed3, out), expected.size());
  EXPECT_EQ(out, expected);
}

TEST(Decode, KeepsNotANumberAndItsBits) {
  const auto data = bytes("01 00 7F A0 00 01");  // field 9, a signalling NaN
  const auto message = decode<messages::VehicleConfiguration>(data, ed3);
  ASSERT_TRUE(message);
  EXPECT_TRUE(std::isnan(*message->gross_weight));
  EXPECT_EQ(encoded(*message, ed3), data);
}

/// Fills every field of a message with the first, or the last, value of its type.
struct FillWithExtreme {
  bool last;

  template <class T>
  void operator()(const FieldInfo& field, std::optional<T>& member) const {
    if constexpr (std::integral<T>)
      member = static_cast<T>(last ? range_of(field).last : range_of(field).first);
    else if constexpr (std::floating_point<T>)
      member = last ? std::numeric_limits<T>::infinity() : std::numeric_limits<T>::lowest();
    else if (field.type == FieldType::text)
      member.emplace(std::string(last ? field.width - 1U : 0U, '~'));
    else
      member.emplace(std::string(last ? variable_text_max : 0U, '~'));
  }
  void operator()(const FieldInfo&, ExcludedField) const {}
};

struct SurvivesAtItsExtremes {
  template <class M>
  void operator()() const {
    for (const auto& profile : {ed3, ed_a}) {
      if (!profile.has_fields(M::info)) continue;
      for (const auto last : {false, true}) {
        M message;
        M::visit(message, FillWithExtreme{last});
        const auto data = encoded(message, profile);
        const auto decoded = decode<M>(data, profile);
        ASSERT_TRUE(decoded) << M::info.name;
        EXPECT_EQ(encoded(*decoded, profile), data) << M::info.name;
        if (profile.edition == Edition::ed_a) {
          EXPECT_EQ(*decoded, message) << M::info.name;
        }
        EXPECT_EQ(walked(M::info, data, profile).empty(), false) << M::info.name;
      }
    }
  }
};

TEST(EveryMessage, SurvivesAtItsExtremesInBothEditions) { messages::for_each_message(SurvivesAtItsExtremes{}); }

TEST(Catalogue, FindsEveryMessageByItsNumber) {
  for (const auto* info : messages::catalogue.messages) EXPECT_EQ(messages::catalogue.find(info->number), info);
  EXPECT_EQ(messages::catalogue.find(MessageNumber{4999}), nullptr);
  EXPECT_EQ(messages::catalogue.find(MessageNumber{0}), nullptr);
  EXPECT_EQ(messages::catalogue.find(MessageNumber{65535}), nullptr);
  EXPECT_EQ(Catalogue{}.find(MessageNumber{1}), nullptr);
}

}  // namespace
}  // namespace ponte::dli
