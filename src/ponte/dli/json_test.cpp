#include "ponte/dli/json.hpp"

#include "ponte/dli/codec.hpp"
#include "ponte/dli/messages/all.hpp"
#include "ponte/dli/messages/catalogue.hpp"
#include "ponte/dli/worked_examples.hpp"
#include "support/bytes.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ponte::dli {
namespace {

using namespace worked_examples;
using Json = nlohmann::json;

const Profile ed3{Edition::ed3};

WrapperView message_of(MessageNumber number, Bytes data) {
  return {.source = vsm, .destination = broadcast_id, .number = number, .data = data};
}

Json json_of(const WrapperView& message, const Profile& profile) {
  JsonText json;
  EXPECT_TRUE(append_json(json, message, messages::catalogue, profile, 1455451200123));
  return Json::parse(json.text());
}

template <class M>
Json fields_of(const M& message) {
  std::vector<std::byte> data(data_size_max);
  data.resize(encode(message, ed3, data).value());
  return json_of(message_of(M::info.number, data), ed3).at("fields");
}

TEST(Json, ShowsTheWorkedExample) {
  const auto input = bytes(attitude_with_sum16);
  JsonText json;
  ASSERT_TRUE(append_json(json, parse_message(input, ed3).value(), messages::catalogue, ed3, 1455451200123));
  EXPECT_EQ(json.text(), R"({"time_ms":1455451200123,"number":4000,"name":"Inertial States","edition":"3",)"
                         R"("source":"14:60:00:02","destination":"14:20:00:02","fields":{)"
                         R"("time_stamp":{"raw":508766400000,"value":508766400,"unit":"s"},)"
                         R"("roll":{"raw":1820,"value":0.1744903146219917,"unit":"rad"},)"
                         R"("pitch":{"raw":-910,"value":-0.08724515731099584,"unit":"rad"},)"
                         R"("heading":{"raw":16384,"value":1.5707963267948966,"unit":"rad"},)"
                         R"("roll_rate":{"raw":20,"value":0.1,"unit":"rad/s"},)"
                         R"("pitch_rate":{"raw":-10,"value":-0.05,"unit":"rad/s"},)"
                         R"("turn_rate":{"raw":4,"value":0.02,"unit":"rad/s"}}})");
}

TEST(Json, UsesTheScalesOfTheProfile) {
  auto profile = ed3;
  profile.override_scale(number, 15, 0.0005);
  const auto input = bytes(attitude_with_sum16);
  EXPECT_EQ(json_of(parse_message(input, ed3).value(), profile)["fields"]["roll_rate"]["value"], 0.01);
}

TEST(Json, LabelsEnumerationsBitmapsAndIds) {
  messages::InertialStates states;
  states.altitude_type = 3;
  EXPECT_EQ(fields_of(states)["altitude_type"], Json::parse(R"({"raw":3,"label":"WGS-84"})"));
  states.altitude_type = 77;
  EXPECT_EQ(fields_of(states)["altitude_type"], Json::parse(R"({"raw":77})"));

  messages::VehicleLightsState lights;
  lights.navigation_lights_state = 0x8045;
  EXPECT_EQ(fields_of(lights)["navigation_lights_state"],
            Json::parse(R"({"raw":32837,"label":["Nav","Strobe","Landing"]})"));
  lights.navigation_lights_state = 0;
  EXPECT_EQ(fields_of(lights)["navigation_lights_state"], Json::parse(R"({"raw":0,"label":[]})"));

  messages::VehicleId vehicle;
  vehicle.vsm_id = 0x14600002;
  vehicle.tail_number.emplace("PT-\"1\"");
  EXPECT_EQ(fields_of(vehicle)["vsm_id"], Json::parse(R"({"raw":341835778,"label":"14:60:00:02"})"));
  EXPECT_EQ(fields_of(vehicle)["tail_number"], Json::parse(R"({"raw":"PT-\"1\""})"));
}

TEST(Json, ShowsFloatsWithTheirUnitAndNotANumberAsText) {
  messages::VehicleConfiguration configuration;
  configuration.gross_weight = 2.5F;
  configuration.x_cg = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(fields_of(configuration)["gross_weight"], Json::parse(R"({"raw":2.5,"unit":"kg"})"));
  EXPECT_EQ(fields_of(configuration)["x_cg"]["raw"], "NaN");
}

TEST(Json, HidesTheUnitOfANumberWithUnknownScale) {
  messages::BatteryReport battery;
  const FieldInfo* unscaled = nullptr;
  messages::BatteryReport::visit(battery, [&]<class T>(const FieldInfo& field, T& member) {
    if (field.scale != 0 || field.unit.empty() || unscaled != nullptr) return;
    unscaled = &field;
    member.emplace();
  });
  ASSERT_NE(unscaled, nullptr);
  EXPECT_EQ(fields_of(battery)[std::string{unscaled->key}], Json::parse(R"({"raw":0})"));
}

TEST(Json, ShowsTheDataOfAMessageWithoutFieldTable) {
  const auto data = bytes("01 00 00 00 00 05 AB");
  const auto iff = json_of(message_of(MessageNumber{5000}, data), ed3);
  EXPECT_EQ(iff["name"], "IFF Code Command");
  EXPECT_EQ(iff["partial"], true);
  EXPECT_EQ(iff["data"], "010000000005ab");
  EXPECT_FALSE(iff.contains("fields"));
  EXPECT_EQ(iff["source"], "14:60:00:02");
  EXPECT_EQ(iff["destination"], "FF:FF:FF:FF");
  EXPECT_EQ(json_of(message_of(MessageNumber{50001}, data), ed3)["name"], "unknown");
  EXPECT_EQ(json_of(message_of(MessageNumber{4}, data), ed3)["partial"], true) << "not in Edition 3";
}

TEST(Json, TellsTheEditionAndItsName) {
  const auto data = bytes("00 00 00");
  const auto json = json_of(message_of(MessageNumber{3002}, data), Profile{Edition::ed_a});
  EXPECT_EQ(json["edition"], "A");
  EXPECT_EQ(json["name"], messages::VehicleOperatingStates::info.name_a);
  EXPECT_TRUE(json["fields"].is_object());
}

TEST(Json, SaysWhenThereWereNewerFields) {
  const auto json = json_of(message_of(MessageNumber{3002}, bytes("80 00 01 00 00 00 00 05 00 01")), ed3);
  EXPECT_EQ(json["newer_fields"], true);
  EXPECT_EQ(json["fields"].size(), 1U);
}

TEST(Json, WritesNothingOfAMessageThatCannotBeDecoded) {
  JsonText json;
  const auto data = bytes("01 F8 01 76 74");
  EXPECT_EQ(append_json(json, message_of(number, data), messages::catalogue, ed3, 0),
            fail(DecodeError{DecodeError::Reason::truncated_field, 1}));
  EXPECT_EQ(json.text(), "");
}

}  // namespace
}  // namespace ponte::dli
