#pragma once

#include "ponte/core/text.hpp"
#include "ponte/mavlink/message_info.hpp"

#include <array>
#include <cstdint>

/// A small dialect for the tests of this folder: real messages, written out by hand in the form of generated ones.
namespace ponte::mavlink::testing {

struct Heartbeat {
  std::uint8_t type{};
  std::uint8_t autopilot{};
  std::uint8_t base_mode{};
  std::uint32_t custom_mode{};
  std::uint8_t system_status{};
  std::uint8_t mavlink_version{3};

  static constexpr std::array<FieldInfo, 6> fields{{
      {"type", FieldType::uint8, 0, 4, false, "", "", nullptr},
      {"autopilot", FieldType::uint8, 0, 5, false, "", "", nullptr},
      {"base_mode", FieldType::uint8, 0, 6, false, "", "", nullptr},
      {"custom_mode", FieldType::uint32, 0, 0, false, "", "", nullptr},
      {"system_status", FieldType::uint8, 0, 7, false, "", "", nullptr},
      {"mavlink_version", FieldType::uint8, 0, 8, false, "", "", nullptr},
  }};
  static constexpr MessageInfo info{MessageId{0}, "HEARTBEAT", 50, 9, 9, fields};

  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(fields[0], self.type);
    visitor(fields[1], self.autopilot);
    visitor(fields[2], self.base_mode);
    visitor(fields[3], self.custom_mode);
    visitor(fields[4], self.system_status);
    visitor(fields[5], self.mavlink_version);
  }

  friend bool operator==(const Heartbeat&, const Heartbeat&) = default;
};

struct Attitude {
  std::uint32_t time_boot_ms{};
  float roll{};
  float pitch{};
  float yaw{};
  float rollspeed{};
  float pitchspeed{};
  float yawspeed{};

  static constexpr std::array<FieldInfo, 7> fields{{
      {"time_boot_ms", FieldType::uint32, 0, 0, false, "ms", "", nullptr},
      {"roll", FieldType::float32, 0, 4, false, "rad", "", nullptr},
      {"pitch", FieldType::float32, 0, 8, false, "rad", "", nullptr},
      {"yaw", FieldType::float32, 0, 12, false, "rad", "", nullptr},
      {"rollspeed", FieldType::float32, 0, 16, false, "rad/s", "", nullptr},
      {"pitchspeed", FieldType::float32, 0, 20, false, "rad/s", "", nullptr},
      {"yawspeed", FieldType::float32, 0, 24, false, "rad/s", "", nullptr},
  }};
  static constexpr MessageInfo info{MessageId{30}, "ATTITUDE", 39, 28, 28, fields};

  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(fields[0], self.time_boot_ms);
    visitor(fields[1], self.roll);
    visitor(fields[2], self.pitch);
    visitor(fields[3], self.yaw);
    visitor(fields[4], self.rollspeed);
    visitor(fields[5], self.pitchspeed);
    visitor(fields[6], self.yawspeed);
  }

  friend bool operator==(const Attitude&, const Attitude&) = default;
};

struct Statustext {
  std::uint8_t severity{};
  Text<50> text{};
  std::uint16_t id{};
  std::uint8_t chunk_seq{};

  static constexpr std::array<FieldInfo, 4> fields{{
      {"severity", FieldType::uint8, 0, 0, false, "", "", nullptr},
      {"text", FieldType::character, 50, 1, false, "", "", nullptr},
      {"id", FieldType::uint16, 0, 51, true, "", "", nullptr},
      {"chunk_seq", FieldType::uint8, 0, 53, true, "", "", nullptr},
  }};
  static constexpr MessageInfo info{MessageId{253}, "STATUSTEXT", 83, 51, 54, fields};

  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(fields[0], self.severity);
    visitor(fields[1], self.text);
    visitor(fields[2], self.id);
    visitor(fields[3], self.chunk_seq);
  }

  friend bool operator==(const Statustext&, const Statustext&) = default;
};

/// Not a real message: every type of field, and an id beyond MAVLink 1.
struct Everything {
  std::int64_t whole{};
  double fine{};
  std::array<std::uint16_t, 3> triple{};
  std::int8_t tiny{};
  char letter{};

  static constexpr std::array<FieldInfo, 5> fields{{
      {"whole", FieldType::int64, 0, 0, false, "", "", nullptr},
      {"fine", FieldType::float64, 0, 8, false, "", "", nullptr},
      {"triple", FieldType::uint16, 3, 16, false, "", "", nullptr},
      {"tiny", FieldType::int8, 0, 22, false, "", "", nullptr},
      {"letter", FieldType::character, 0, 23, false, "", "", nullptr},
  }};
  static constexpr MessageInfo info{MessageId{70000}, "EVERYTHING", 77, 24, 24, fields};

  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(fields[0], self.whole);
    visitor(fields[1], self.fine);
    visitor(fields[2], self.triple);
    visitor(fields[3], self.tiny);
    visitor(fields[4], self.letter);
  }

  friend bool operator==(const Everything&, const Everything&) = default;
};

/// MAVLink 0.9.
struct AttitudeV09 {
  std::uint64_t usec{};
  float roll{};
  float pitch{};
  float yaw{};
  float rollspeed{};
  float pitchspeed{};
  float yawspeed{};

  static constexpr std::array<FieldInfo, 7> fields{{
      {"usec", FieldType::uint64, 0, 0, false, "us", "", nullptr, false, true},
      {"roll", FieldType::float32, 0, 8, false, "rad", "", nullptr, false, true},
      {"pitch", FieldType::float32, 0, 12, false, "rad", "", nullptr, false, true},
      {"yaw", FieldType::float32, 0, 16, false, "rad", "", nullptr, false, true},
      {"rollspeed", FieldType::float32, 0, 20, false, "rad/s", "", nullptr, false, true},
      {"pitchspeed", FieldType::float32, 0, 24, false, "rad/s", "", nullptr, false, true},
      {"yawspeed", FieldType::float32, 0, 28, false, "rad/s", "", nullptr, false, true},
  }};
  static constexpr MessageInfo info{MessageId{30}, "ATTITUDE", 0, 32, 32, fields};

  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(fields[0], self.usec);
    visitor(fields[1], self.roll);
    visitor(fields[2], self.pitch);
    visitor(fields[3], self.yaw);
    visitor(fields[4], self.rollspeed);
    visitor(fields[5], self.pitchspeed);
    visitor(fields[6], self.yawspeed);
  }

  friend bool operator==(const AttitudeV09&, const AttitudeV09&) = default;
};

/// Not a real message: as long as a longest text, and of another length than a second one with the same id.
struct EverythingV09 {
  std::array<std::int16_t, 3> triple{};
  Text<30> text{};
  double fine{};

  static constexpr std::array<FieldInfo, 3> fields{{
      {"triple", FieldType::int16, 3, 0, false, "", "", nullptr, false, true},
      {"text", FieldType::character, 30, 6, false, "", "", nullptr, false, true},
      {"fine", FieldType::float64, 0, 36, false, "", "", nullptr, false, true},
  }};
  static constexpr MessageInfo info{MessageId{30}, "EVERYTHING", 0, 44, 44, fields};

  template <class Self, class Visitor>
  static constexpr void visit(Self& self, Visitor&& visitor) {
    visitor(fields[0], self.triple);
    visitor(fields[1], self.text);
    visitor(fields[2], self.fine);
  }

  friend bool operator==(const EverythingV09&, const EverythingV09&) = default;
};

inline constexpr std::array<const MessageInfo*, 2> messages_v09{&AttitudeV09::info, &EverythingV09::info};
inline constexpr Dialect dialect_v09{"testing_v09", messages_v09};

inline constexpr std::array<const MessageInfo*, 4> messages{&Heartbeat::info, &Attitude::info, &Statustext::info,
                                                            &Everything::info};
inline constexpr Dialect dialect{"testing", messages, &dialect_v09};

// Frames as pymavlink 2.4.50 writes them.
/// HEARTBEAT of system 1, component 1, sequence 42.
inline constexpr auto heartbeat_frame = "fd 09 00 00 2a 01 01 00 00 00  04 00 00 00 02 03 51 04 03  8f a1";
/// The same in MAVLink 1.
inline constexpr auto heartbeat_v1_frame = "fe 09 2a 01 01 00  04 00 00 00 02 03 51 04 03  e9 da";
/// The same, signed with the key 00 01 ... 1f, link id 7, time stamp 1000.
inline constexpr auto heartbeat_signed_frame =
    "fd 09 01 00 2a 01 01 00 00 00  04 00 00 00 02 03 51 04 03  68 59  07 e8 03 00 00 00 00 8b d6 38 6f 45 f6";
/// ATTITUDE of MAVLink 0.9, as the C headers of 2011 write it: 0.1, 0.2, 0.3 rad and 0.01, 0.02, 0.03 rad/s.
inline constexpr auto attitude_v09_frame =
    "55 20 01 01 01 1e  00 00 00 00 00 0f 42 40 3d cc cc cd 3e 4c cc cd 3e 99 99 9a 3c 23 d7 0a 3c a3 d7 0a 3c f5 c2 "
    "8f "
    " 24 c6";
/// ATTITUDE of system 1, component 1, sequence 7.
inline constexpr auto attitude_frame =
    "fd 1c 00 00 07 01 01 1e 00 00  40 e2 01 00 cd cc cc 3d cd cc 4c be 00 00 40 40 0a d7 23 3c 0a d7 a3 3c 8f c2 f5 "
    "bc  9b cb";
/// STATUSTEXT of system 1, component 1, sequence 8: severity 6, "Init Gyro**".
inline constexpr auto statustext_frame = "fd 0c 00 00 08 01 01 fd 00 00  06 49 6e 69 74 20 47 79 72 6f 2a 2a  b6 7c";
/// RADIO_STATUS, which is not in the dialect above, with all fields zero.
inline constexpr auto radio_status_frame = "fd 01 00 00 09 01 01 6d 00 00  00  ca 67";

}  // namespace ponte::mavlink::testing
