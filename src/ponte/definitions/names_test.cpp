#include "ponte/definitions/names.hpp"

#include <gtest/gtest.h>

namespace ponte::definitions {
namespace {

TEST(SnakeCase, TakesTheSpellingsOfBothStandards) {
  EXPECT_EQ(snake_case("ATTITUDE"), "attitude");
  EXPECT_EQ(snake_case("Roll Rate"), "roll_rate");
  EXPECT_EQ(snake_case("U_Speed"), "u_speed");
  EXPECT_EQ(snake_case("EO/IR/Laser Payload Command"), "eo_ir_laser_payload_command");
  EXPECT_EQ(snake_case("IFF Ident (Squawk) Command"), "iff_ident_squawk_command");
  EXPECT_EQ(snake_case("Waypoint - Latitude"), "waypoint_latitude");
}

TEST(SnakeCase, EscapesKeywordsAndNamesThatGeneratedStructsUse) {
  EXPECT_EQ(snake_case("Default"), "default_");
  EXPECT_EQ(snake_case("namespace"), "namespace_");
  EXPECT_EQ(snake_case("co_await"), "co_await_");
  EXPECT_EQ(snake_case("fields"), "fields_");
  EXPECT_EQ(snake_case("Info"), "info_");
  EXPECT_EQ(snake_case("visit"), "visit_");
  EXPECT_EQ(snake_case("visits"), "visits");
}

TEST(SnakeCase, LeavesAnEscapedNameAsItIs) {
  for (const auto* name : {"default_", "_2d", "fields_", "roll_rate"}) EXPECT_EQ(snake_case(name), name);
}

TEST(SnakeCase, NeverBeginsWithADigit) { EXPECT_EQ(snake_case("2D Fix"), "_2d_fix"); }

TEST(SnakeCase, IsEmptyWithoutALetterOrDigit) {
  EXPECT_EQ(snake_case(""), "");
  EXPECT_EQ(snake_case(" _ - / "), "");
  EXPECT_EQ(snake_case("\xC3\xA9"), "");
}

TEST(PascalCase, JoinsTheWords) {
  EXPECT_EQ(pascal_case("inertial_states"), "InertialStates");
  EXPECT_EQ(pascal_case("GPS_RAW_INT"), "GpsRawInt");
  EXPECT_EQ(pascal_case("_2d_fix"), "_2dFix");
}

TEST(IsIdentifier, RefusesWhatCannotStandInCode) {
  EXPECT_TRUE(is_identifier("MAV_STATE_ACTIVE"));
  EXPECT_TRUE(is_identifier("_private"));
  for (const auto* name : {"", "2D", "A B", "A-B", "int", "A;", "\xC3\xA9"}) EXPECT_FALSE(is_identifier(name)) << name;
}

TEST(Literal, EscapesWhatWouldEndIt) {
  EXPECT_EQ(literal("plain"), R"("plain")");
  EXPECT_EQ(literal(R"(a "b" \ c)"), R"("a \"b\" \\ c")");
  EXPECT_EQ(literal("a\nb\rc"), R"("a b c")");
}

TEST(OneLine, FoldsWhiteSpaceSoThatACommentStaysAComment) {
  EXPECT_EQ(one_line("  two\n   lines\t"), "two lines");
  EXPECT_EQ(one_line("carriage\rreturn"), "carriage return");
  EXPECT_EQ(one_line("a comment that goes on \\"), "a comment that goes on");
}

}  // namespace
}  // namespace ponte::definitions
