#include "ponte/sim/parameter_service.hpp"

#include "ponte/mavlink/autopilots/param_error.hpp"
#include "ponte/mavlink/autopilots/param_request_list.hpp"
#include "ponte/mavlink/autopilots/param_value.hpp"
#include "ponte/sim/test_station.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <set>

namespace ponte::sim {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

class ParameterServiceTest : public ::testing::TestWithParam<Personality> {
 protected:
  ParameterServiceTest() {
    station_.wait(seconds{9});
    station_.forget();
  }

  std::vector<messages::ParamValue> set(std::string_view name, float value, ParameterType type) {
    station_.forget();
    station_.send(messages::ParamSet{.target_system = 1,
                                     .target_component = 1,
                                     .param_id = name,
                                     .param_value = value,
                                     .param_type = static_cast<std::uint8_t>(type)});
    station_.wait(milliseconds{200});
    return station_.all<messages::ParamValue>();
  }

  std::vector<messages::ParamValue> read(std::string_view name, std::int16_t index = -1) {
    station_.forget();
    station_.send(
        messages::ParamRequestRead{.target_system = 1, .target_component = 1, .param_id = name, .param_index = index});
    station_.wait(milliseconds{200});
    return station_.all<messages::ParamValue>();
  }

  TestStation station_{{.personality = GetParam(), .fly_square = false}};
};

class ArduPilotParameters : public ParameterServiceTest {};
class Px4Parameters : public ParameterServiceTest {};
INSTANTIATE_TEST_SUITE_P(, ArduPilotParameters, ::testing::Values(Personality::ardupilot));
INSTANTIATE_TEST_SUITE_P(, Px4Parameters, ::testing::Values(Personality::px4));
INSTANTIATE_TEST_SUITE_P(Both, ParameterServiceTest, ::testing::Values(Personality::ardupilot, Personality::px4));

TEST_P(ParameterServiceTest, SendsTheWholeListWithinASecondAndLosesNothing) {
  station_.send(messages::ParamRequestList{.target_system = 1, .target_component = 1});
  station_.wait(seconds{1});
  std::set<unsigned> indices;
  for (const auto& each : station_.all<messages::ParamValue>()) {
    if (each.param_index == 65535) continue;
    EXPECT_TRUE(indices.insert(each.param_index).second) << each.param_id.view();
  }
  ASSERT_FALSE(indices.empty());
  EXPECT_THAT(indices, SizeIs(station_.last<messages::ParamValue>().param_count));
  EXPECT_EQ(*indices.rbegin() + 1, indices.size());
  EXPECT_EQ(station_.lost(), 0U);
}

TEST(ParameterServiceOnASlowLine, TakesAThirdOfIt) {
  TestStation station{{.fly_square = false, .line_rate = 11'520}};
  station.wait(seconds{10});
  station.forget();
  station.send(messages::ParamRequestList{.target_system = 1, .target_component = 1});
  station.wait(seconds{5});
  EXPECT_EQ(station.all<messages::ParamValue>().size(), 5U * 50 * 2);
}

TEST_P(ParameterServiceTest, IgnoresRequestsToAnotherSystem) {
  station_.send(messages::ParamRequestList{.target_system = 9, .target_component = 1});
  station_.wait(seconds{1});
  EXPECT_THAT(station_.all<messages::ParamValue>(), IsEmpty());
}

TEST_P(ParameterServiceTest, KeepsWhatWasSetOverAReboot) {
  const bool is_px4 = GetParam() == Personality::px4;
  const auto* name = is_px4 ? "MIS_TAKEOFF_ALT" : "BATT_LOW_VOLT";
  set(name, 12.5F, ParameterType::real32);
  ASSERT_EQ(station_.command(messages::MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, {1}), 0U);
  station_.wait(seconds{3});
  EXPECT_EQ(read(name).at(0).param_value, 12.5F);
}

TEST_P(ArduPilotParameters, TellNumbersAsFloatsWithoutAnIndex) {
  const auto answers = read("RTL_ALT");
  ASSERT_THAT(answers, SizeIs(1));
  EXPECT_EQ(answers[0].param_value, 1500.0F);
  EXPECT_EQ(answers[0].param_type, 6);
  EXPECT_EQ(answers[0].param_index, 65535);
  EXPECT_EQ(read("", 3).at(0).param_index, 3);
}

TEST_P(ArduPilotParameters, AreSilentAboutUnknownNames) {
  EXPECT_THAT(read("NO_SUCH_PARAM"), IsEmpty());
  EXPECT_THAT(read("", 9999), IsEmpty());
  EXPECT_THAT(set("NO_SUCH", 1, ParameterType::real32), IsEmpty());
  EXPECT_THAT(station_.all<messages::ParamError>(), IsEmpty());
}

TEST_P(ArduPilotParameters, AreSetWhateverTheTypeSays) {
  const auto answers = set("FS_GCS_ENABLE", 1, ParameterType::real32);
  ASSERT_THAT(answers, SizeIs(1));
  EXPECT_EQ(answers[0].param_value, 1);
  EXPECT_EQ(answers[0].param_type, 2) << "told as the right one";
  EXPECT_THAT(set("FS_GCS_ENABLE", std::numeric_limits<float>::quiet_NaN(), ParameterType::int8), IsEmpty());
  EXPECT_EQ(read("FS_GCS_ENABLE").at(0).param_value, 1);
}

TEST_P(ArduPilotParameters, AreReadWithinATenthOfASecond) {
  station_.wait(milliseconds{10});
  station_.send(
      messages::ParamRequestRead{.target_system = 1, .param_id = std::string_view{"RTL_ALT"}, .param_index = -1});
  EXPECT_THAT(station_.all<messages::ParamValue>(), IsEmpty());
  station_.wait(milliseconds{100});
  EXPECT_THAT(station_.all<messages::ParamValue>(), SizeIs(1));
}

TEST_P(Px4Parameters, TellTheBitsOfIntegers) {
  const auto answers = read("COM_DL_LOSS_T");
  ASSERT_THAT(answers, SizeIs(1));
  EXPECT_EQ(std::bit_cast<std::int32_t>(answers[0].param_value), 10);
  EXPECT_LT(answers[0].param_index, answers[0].param_count);
}

TEST_P(Px4Parameters, BeginTheListWithAHashOfAllValues) {
  const auto hash = [&] {
    station_.forget();
    station_.send(messages::ParamRequestList{.target_system = 1, .target_component = 1});
    station_.wait(seconds{1});
    const auto first = station_.all<messages::ParamValue>().at(0);
    EXPECT_EQ(first.param_id.view(), "_HASH_CHECK");
    EXPECT_EQ(first.param_type, 5);
    return std::bit_cast<std::uint32_t>(first.param_value);
  };
  const auto before = hash();
  EXPECT_EQ(hash(), before);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(read("_HASH_CHECK").at(0).param_value), before);
  set("MIS_TAKEOFF_ALT", 12.5F, ParameterType::real32);
  EXPECT_NE(hash(), before);
}

TEST_P(Px4Parameters, RefuseUnknownNamesAndWrongTypesByName) {
  const auto errors = [&] {
    std::vector<unsigned> result;
    for (const auto& each : station_.all<messages::ParamError>()) result.push_back(each.error);
    return result;
  };
  EXPECT_THAT(read("NO_SUCH_PARAM"), IsEmpty());
  EXPECT_THAT(errors(), ::testing::ElementsAre(1));
  EXPECT_THAT(set("NO_SUCH", 1, ParameterType::real32), IsEmpty());
  EXPECT_THAT(errors(), ::testing::ElementsAre(1));
  EXPECT_THAT(set("NAV_DLL_ACT", 2, ParameterType::real32), IsEmpty());
  EXPECT_THAT(errors(), ::testing::ElementsAre(7));
}

TEST_P(Px4Parameters, TellTwiceWhatWasSet) {
  const auto answers = set("NAV_DLL_ACT", std::bit_cast<float>(std::int32_t{3}), ParameterType::int32);
  ASSERT_THAT(answers, SizeIs(2));
  for (const auto& each : answers) EXPECT_EQ(std::bit_cast<std::int32_t>(each.param_value), 3);
}

}  // namespace
}  // namespace ponte::sim
