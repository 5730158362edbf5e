#include "ponte/autopilot/parameter_pack.hpp"

#include "support/bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ponte::autopilot {
namespace {

using ::testing::ElementsAre;

// ACRO_A of 8 bits; ACRO_BAL of 32 bits, which shares "ACRO_"; a byte that fills the block; a float with its default.
constexpr auto file =
    "1c 67 03 00 03 00  01 50 41 43 52 4f 5f 41 fe  03 25 42 41 4c e8 03 00 00  00"
    "14 00 5a 00 00 20 40 00 00 80 3f";

TEST(UnpackParameters, ReadsTypesNamesAndValues) {
  EXPECT_THAT(unpack_parameters(bytes(file)).value(),
              ElementsAre(Parameter{ParameterName{"ACRO_A"}, ParameterType::int8, -2},
                          Parameter{ParameterName{"ACRO_BAL"}, ParameterType::int32, 1000},
                          Parameter{ParameterName{"Z"}, ParameterType::real32, 2.5}));
}

TEST(UnpackParameters, RefusesEveryShorterFile) {
  const auto whole = bytes(file);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(unpack_parameters(Bytes{whole}.first(size)).has_value()) << size;
}

TEST(UnpackParameters, SaysWhatIsWrong) {
  EXPECT_EQ(unpack_parameters(bytes("1a 67 00 00 00 00")),
            fail(PackError{0, "it does not begin with the magic number"}));
  EXPECT_EQ(unpack_parameters(bytes("1b 67 01 00 01 00 05 00 41 01")), fail(PackError{6, "the type is unknown"}));
  EXPECT_EQ(unpack_parameters(bytes("1b 67 01 00 01 00 01 01 41 01")),
            fail(PackError{7, "the lengths of the name do not fit"}));
  EXPECT_EQ(unpack_parameters(bytes("1b 67 01 00 01 00 01 10 41 00 01")), fail(PackError{8, "the name has a NUL"}));
}

}  // namespace
}  // namespace ponte::autopilot
