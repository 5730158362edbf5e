#include "ponte/vsm/changes.hpp"

#include "ponte/dli/messages/eo_ir_laser_payload_command.hpp"
#include "ponte/dli/messages/inertial_states.hpp"

#include <gtest/gtest.h>

namespace ponte::vsm {
namespace {

using dli::messages::InertialStates;

TEST(KeepChanges, LeavesWhatHasAnotherValueThanLastTime) {
  InertialStates told{.time_stamp = 1, .roll = 10, .pitch = 20};
  InertialStates message{.time_stamp = 2, .altitude = 5, .roll = 10, .pitch = 21};
  EXPECT_TRUE(keep_changes(message, told));
  EXPECT_EQ(message, (InertialStates{.time_stamp = 2, .altitude = 5, .pitch = 21}));
  EXPECT_EQ(told.altitude, 5);
  EXPECT_EQ(told.pitch, 21);
  EXPECT_EQ(told.roll, 10);
}

TEST(KeepChanges, SaysWhenNothingIsLeftButTheTime) {
  InertialStates told{.roll = 10};
  InertialStates message{.time_stamp = 2, .roll = 10};
  EXPECT_FALSE(keep_changes(message, told));
  EXPECT_EQ(message, (InertialStates{.time_stamp = 2}));
}

TEST(KeepChanges, RemembersAFieldThatIsAbsentForAWhile) {
  InertialStates told{.roll = 10};
  InertialStates without{.time_stamp = 2};
  EXPECT_FALSE(keep_changes(without, told));
  InertialStates again{.time_stamp = 3, .roll = 10};
  EXPECT_FALSE(keep_changes(again, told));
}

TEST(KeepChanges, PassesOverFieldsThatAreOutOfScope) {
  using dli::messages::EoIrLaserPayloadCommand;
  EoIrLaserPayloadCommand told{.preplan_mode = 1};
  EoIrLaserPayloadCommand message{.preplan_mode = 2};
  EXPECT_TRUE(keep_changes(message, told));
  EXPECT_EQ(told.preplan_mode, 2);
}

}  // namespace
}  // namespace ponte::vsm
