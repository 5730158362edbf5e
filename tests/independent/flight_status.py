"""Modes, states, alerts and subsystems: what an autopilot's words mean in the DLI, written from the mapping facts.

Edition 3 leaves some numbers to the VSM: modes from 32 and AV states from 10 on are the ones that the mapping chose.
"""

from __future__ import annotations

from typing import NamedTuple

OWN = None  # a mode that only this autopilot has: any number from OWN_FROM on, another one for each
OWN_FROM = 64

NO_MODE, MANUAL, WAYPOINT, LOITER, AUTOPILOT, AUTOLAND, LAUNCH = 0, 2, 11, 12, 15, 19, 21
RTL, SMART_RTL, QRTL = 32, 33, 34

COPTER = {
    "STABILIZE": (0, MANUAL), "ACRO": (1, MANUAL), "ALT_HOLD": (2, MANUAL), "AUTO": (3, WAYPOINT),
    "GUIDED": (4, AUTOPILOT), "LOITER": (5, LOITER), "RTL": (6, RTL), "CIRCLE": (7, LOITER), "LAND": (9, AUTOLAND),
    "DRIFT": (11, OWN), "SPORT": (13, MANUAL), "FLIP": (14, OWN), "AUTOTUNE": (15, OWN), "POSHOLD": (16, LOITER),
    "BRAKE": (17, LOITER), "THROW": (18, OWN), "AVOID_ADSB": (19, OWN), "GUIDED_NOGPS": (20, OWN),
    "SMART_RTL": (21, SMART_RTL), "FLOWHOLD": (22, OWN), "FOLLOW": (23, OWN), "ZIGZAG": (24, OWN),
    "SYSTEMID": (25, OWN), "AUTOROTATE": (26, OWN), "AUTO_RTL": (27, OWN), "TURTLE": (28, OWN),
}  # fmt: skip
PLANE = {
    "MANUAL": (0, MANUAL), "CIRCLE": (1, LOITER), "STABILIZE": (2, MANUAL), "TRAINING": (3, OWN), "ACRO": (4, OWN),
    "FBWA": (5, MANUAL), "FBWB": (6, MANUAL), "CRUISE": (7, AUTOPILOT), "AUTOTUNE": (8, OWN), "AUTO": (10, WAYPOINT),
    "RTL": (11, RTL), "LOITER": (12, LOITER), "TAKEOFF": (13, LAUNCH), "AVOID_ADSB": (14, OWN),
    "GUIDED": (15, AUTOPILOT), "INITIALISING": (16, NO_MODE), "QSTABILIZE": (17, OWN), "QHOVER": (18, OWN),
    "QLOITER": (19, LOITER), "QLAND": (20, AUTOLAND), "QRTL": (21, QRTL), "QAUTOTUNE": (22, OWN), "QACRO": (23, OWN),
    "THERMAL": (24, OWN), "LOITER_ALT_QLAND": (25, OWN), "AUTOLAND": (26, AUTOLAND),
}  # fmt: skip


def px4(main: int, sub: int = 0) -> int:
    """PX4's custom_mode."""
    return main << 16 | sub << 24


PX4_MODES = {
    "MANUAL": (px4(1), MANUAL), "ALTCTL": (px4(2), MANUAL), "POSCTL": (px4(3), MANUAL),
    "POSCTL.ORBIT": (px4(3, 1), LOITER), "POSCTL.SLOW": (px4(3, 2), MANUAL), "AUTO.READY": (px4(4, 1), OWN),
    "AUTO.TAKEOFF": (px4(4, 2), LAUNCH), "AUTO.LOITER": (px4(4, 3), LOITER), "AUTO.MISSION": (px4(4, 4), WAYPOINT),
    "AUTO.RTL": (px4(4, 5), RTL), "AUTO.LAND": (px4(4, 6), AUTOLAND), "AUTO.FOLLOW_TARGET": (px4(4, 8), AUTOPILOT),
    "AUTO.PRECLAND": (px4(4, 9), OWN), "AUTO.VTOL_TAKEOFF": (px4(4, 10), OWN),
    **{f"AUTO.EXTERNAL{n}": (px4(4, 10 + n), OWN) for n in range(1, 9)}, "AUTO.GUIDED_COURSE": (px4(4, 19), OWN),
    "ACRO": (px4(5), MANUAL), "OFFBOARD": (px4(6), AUTOPILOT), "STABILIZED": (px4(7), MANUAL),
    "RATTITUDE": (px4(8), OWN), "SIMPLE": (px4(9), OWN), "TERMINATION": (px4(10), OWN),
    "ALTITUDE_CRUISE": (px4(11), OWN),
}  # fmt: skip


class Life(NamedTuple):
    """What HEARTBEAT and EXTENDED_SYS_STATE say of where a vehicle is in its life."""

    landed_state: int = 1  # MAV_LANDED_STATE: 1 on ground, 2 in air, 3 take-off, 4 landing
    armed: bool = False
    system_status: int = 3  # MAV_STATE


# The AV State of #3002: 1 power up, 2 pre-start, 3 pre-launch, 10 take-off, 11 in flight, 12 landing, 13 critical.
AV_STATES = {
    Life(1, False, 0): 1, Life(1, False, 1): 1, Life(1, False, 2): 1, Life(1, False, 3): 2, Life(1, True, 3): 3,
    Life(1, True, 4): 3, Life(3, True, 4): 10, Life(2, True, 4): 11, Life(4, True, 4): 12, Life(2, True, 5): 13,
}  # fmt: skip

UNKNOWN_STATE = 0  # when the vehicle is not heard any more

NO_STATUS, NOMINAL, CAUTION, WARNING, EMERGENCY = 0, 1, 2, 3, 4
PRIORITY_OF_SEVERITY = {0: EMERGENCY, 1: EMERGENCY, 2: WARNING, 3: WARNING, 4: CAUTION, 5: NOMINAL, 6: NOMINAL}
CLEARABLE, TIMED = 2, 3
PERSISTENCE_S = 10
NO_REPORT = -1
TEXT_SIZE_MAX = 79

ENGINE, ELECTRICAL, COMMS, ENERGY, NAVIGATION, PAYLOAD, RECOVERY, VSM = 0, 2, 3, 4, 5, 6, 7, 9

# Texts as autopilots send them, with the subsystem whose word stands in them.
TEXTS = {
    "EKF variance": NAVIGATION, "EKF2 IMU0 is using GPS": NAVIGATION, "EKF3 lane switch": NAVIGATION,
    "AHRS: waiting for home": NAVIGATION, "GPS Glitch cleared": NAVIGATION, "Compass not calibrated": NAVIGATION,
    "Gyro not healthy": NAVIGATION, "Gyros inconsistent": NAVIGATION, "Accels inconsistent": NAVIGATION,
    "Need position estimate": NAVIGATION, "Battery failsafe": ENERGY, "Fuel low": ENERGY, "Motor 2 stopped": ENGINE,
    "Motors locked": ENGINE, "ESC failure": ENGINE, "Engine running": ENGINE, "RC not calibrated": COMMS,
    "Radio failsafe": COMMS, "Link lost": COMMS, "GCS failsafe": COMMS, "Gimbal ready": PAYLOAD,
    "Mount not healthy": PAYLOAD, "Camera ready": PAYLOAD, "Parachute released": RECOVERY, "Hello there": VSM,
}  # fmt: skip

# Bits of SYS_STATUS.onboard_control_sensors_*; from 32 on those of onboard_control_sensors_*_extended.
SUBSYSTEM_OF_BIT = {
    **dict.fromkeys((*range(15), *range(17, 23), 26, 29), NAVIGATION), **dict.fromkeys((15, 23, 30), ENGINE),
    16: COMMS, 27: COMMS, 24: ELECTRICAL, 25: ENERGY, 28: VSM, 32: RECOVERY,
}  # fmt: skip
PRE_ARM_BIT = 28
EXTENDED_BITS_USED = 31
FIRST_OF_SECOND = {17: 0, 18: 1, 19: 2}


def subsystem_states(present: int, enabled: int, healthy: int, armed: bool) -> dict[int, int]:
    """The state of each subsystem that any fitted and enabled sensor belongs to."""
    states: dict[int, int] = {}
    for bit, subsystem in SUBSYSTEM_OF_BIT.items():
        if not (present & enabled) >> bit & 1 or (bit == PRE_ARM_BIT and armed):
            continue
        state = NOMINAL
        if not healthy >> bit & 1:
            first = FIRST_OF_SECOND.get(bit)
            excused = first is not None and (present & enabled & healthy) >> first & 1
            state = CAUTION if excused or bit == PRE_ARM_BIT else WARNING
        states[subsystem] = max(states.get(subsystem, NOMINAL), state)
    return states
