#pragma once

#include "ponte/dli/wrapper.hpp"

#include <string_view>

/// Message #4000 Inertial States of a vehicle in Portugal, worked out by hand from the text of Edition 3: roll 10,
/// pitch -5 and heading 90 degrees, rates 0.10, -0.05 and 0.02 rad/s, on 2016-02-14 at 12:00:00 UTC. For tests.
namespace ponte::dli::worked_examples {

inline constexpr std::string_view attitude_without_checksum =
    "FF FF 00 14 14 60 00 02 14 20 00 02 0F A0 1E 00"
    "01 F8 01 76 74 D7 2E 00 07 1C FC 72 40 00 00 14 FF F6 00 04";

inline constexpr std::string_view attitude_with_sum16 =
    "FF FF 00 14 14 60 00 02 14 20 00 02 0F A0 1E 40"
    "01 F8 01 76 74 D7 2E 00 07 1C FC 72 40 00 00 14 FF F6 00 04 0A 92";

inline constexpr std::string_view attitude_with_sum32 =
    "FF FF 00 14 14 60 00 02 14 20 00 02 0F A0 1E 80"
    "01 F8 01 76 74 D7 2E 00 07 1C FC 72 40 00 00 14 FF F6 00 04 00 00 0A D2";

/// All 18 fields: also 38.7223 degrees north, 9.1393 west, 120.5 m WGS-84, velocity 12.3, -4.5, -1.0 m/s, no
/// acceleration, magnetic variation -2.5 degrees.
inline constexpr std::string_view all_fields_with_sum16 =
    "FF FF 00 2E 14 60 00 02 14 20 00 02 0F A0 1E 40"
    "03 FF FF 76 74 D7 2E 00 1B 89 2D FA F9 80 3D C0 00 17 89 03"
    "00 F6 FF A6 FF EC 00 00 00 00 00 00 07 1C FC 72 40 00"
    "00 14 FF F6 00 04 FE 39 16 54";

inline constexpr MessageNumber number{4000};
inline constexpr EntityId vsm{20, EntityType::vsm, 2};
inline constexpr EntityId cucs{20, EntityType::cucs, 2};
inline constexpr Envelope envelope{vsm, cucs};

inline Profile profile_with(Checksum checksum, Edition edition = Edition::ed3) {
  Profile profile{edition};
  profile.checksum = checksum;
  return profile;
}

}  // namespace ponte::dli::worked_examples
