#pragma once

#include "ponte/core/bytes.hpp"
#include "ponte/core/quantity.hpp"
#include "ponte/planning/formats/mission_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

// What the tests of the formats share.
namespace ponte::planning {

/// A file of tests/vectors/missions.
inline std::vector<std::byte> vector_file(const std::string& name) {
  std::ifstream file{PONTE_SOURCE_DIR "/tests/vectors/missions/" + name, std::ios::binary};
  EXPECT_TRUE(file) << name;
  const std::string text{std::istreambuf_iterator<char>{file}, {}};
  const auto bytes = bytes_of(text);
  return {bytes.begin(), bytes.end()};
}

inline vehicle::Place place(double latitude, double longitude) {
  return {radians_from_degrees(latitude), radians_from_degrees(longitude)};
}

/// "line 7: latitude is 91: expected -90 to 90", or "read".
inline std::string refusal(const ReadingResult& reading) {
  if (reading) return "read";
  const auto& [where, what, expectation] = reading.error();
  return to_text(where) + ": " + what + ": expected " + expectation;
}

/// "line 7: ..." for each.
inline std::vector<std::string> remarks(const ReadingResult& reading) {
  std::vector<std::string> texts;
  if (!reading) return {refusal(reading)};
  for (const auto& [where, text] : reading->remarks) texts.push_back(to_text(where) + ": " + text);
  return texts;
}

/// What it holds; nothing, and a failed test, where it was refused.
inline MissionFile content(const ReadingResult& reading) {
  EXPECT_EQ(refusal(reading), "read");
  return reading ? reading->content : MissionFile{};
}

inline std::string text_of(const Writing& writing) {
  return {reinterpret_cast<const char*>(writing.bytes.data()), writing.bytes.size()};
}

}  // namespace ponte::planning
