#include "ponte/core/json_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace ponte {
namespace {

TEST(JsonText, PutsCommasWhereTheyBelong) {
  JsonText json;
  json.begin_object().member("a", 1).key("b").begin_array().value(true).value("x").end_array().key("c").begin_object();
  json.end_object().end_object();
  EXPECT_EQ(json.text(), R"({"a":1,"b":[true,"x"],"c":{}})");
  json.clear();
  json.begin_object().end_object();
  EXPECT_EQ(json.text(), "{}");
}

TEST(JsonText, KeepsEveryNumberExactly) {
  JsonText json;
  json.begin_array().value(0.1).value(0.1F).value(std::numeric_limits<double>::quiet_NaN());
  json.value(-std::numeric_limits<float>::infinity()).value(std::numeric_limits<std::uint64_t>::max());
  json.value(std::numeric_limits<std::int64_t>::min()).value(std::int64_t{-9007199254740992});
  json.value(std::uint64_t{9007199254740991}).end_array();
  EXPECT_EQ(json.text(),
            R"([0.1,0.1,"NaN","-Infinity","18446744073709551615","-9223372036854775808",-9007199254740992,)"
            R"(9007199254740991])");
}

TEST(JsonText, KeepsTheSignOfZero) {
  JsonText json;
  json.begin_array().value(-0.0).value(-0.0F).value(0.0).end_array();
  EXPECT_EQ(json.text(), "[-0.0,-0.0,0]");
}

TEST(JsonText, EscapesWhatIsNotPrintableUtf8) {
  JsonText json;
  json.value(std::string_view{"\"\\\n\xC3\xA3\xFFz\xED\xA0\x80"});
  EXPECT_EQ(json.text(), "\"\\\"\\\\\\u000a\xC3\xA3\\u00ffz\\u00ed\\u00a0\\u0080\"");
}

}  // namespace
}  // namespace ponte
