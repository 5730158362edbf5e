"""Every field of #3, #3001, #4001, #16000 and #16001: pymavlink sends, `ponte vsm` translates, the independent reader
and the independent tables judge."""

from __future__ import annotations

import random
import time
from types import ModuleType
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as dialect_v2

import flight_status
from dli_reader import Message, identifier
from programs import seed_or
from vsm_bench import ARDUPILOT, DIALECTS, FIXED_WING, PX4, QUADROTOR
from vsm_bench import StartVsm, Vehicle, meet, raws

DEFAULT_SEED = 42
VEHICLE_ID, MODE_REPORT, OPERATING_STATES = 3, 3001, 3002
ALERT, SUBSYSTEM_REPORT, HEARTBEAT = 16000, 16001, 16002
STACKS = {
    "ArduCopter": (QUADROTOR, ARDUPILOT, flight_status.COPTER),
    "ArduPlane": (FIXED_WING, ARDUPILOT, flight_status.PLANE),
    "PX4": (QUADROTOR, PX4, flight_status.PX4_MODES),
}

def told(messages: list[Message], number: int) -> list[dict[int, Any]]:
    """The fields of all messages of one number, but for their time."""
    found = [raws(message) for message in messages if message.number == number]
    assert all(0 <= fields.pop(1) < 2**40 for fields in found)
    return found


@DIALECTS
@pytest.mark.parametrize("stack", STACKS)
def test_every_mode_is_reported(start_vsm: StartVsm, dialect: ModuleType, stack: str) -> None:
    airframe, autopilot, modes = STACKS[stack]
    vehicle = meet(start_vsm, dialect, airframe=airframe, autopilot=autopilot)
    own: dict[int, str] = {}
    for name, (custom_mode, wanted) in random.Random(seed_or(DEFAULT_SEED)).sample(list(modes.items()), len(modes)):
        other = modes["AUTO" if autopilot == ARDUPILOT else "AUTO.MISSION"][0]
        vehicle.say("heartbeat", airframe, autopilot, 81, other, 3, 3)
        vehicle.say("heartbeat", airframe, autopilot, 81, custom_mode, 3, 3)
        report = told(vehicle.answers(), MODE_REPORT)[-1]
        assert report.keys() == {2}
        if wanted is flight_status.OWN:
            assert flight_status.OWN_FROM <= report[2] <= 255, name
            assert report[2] not in own, f"{name} is told as {own.get(report[2])}"
            own[report[2]] = name
        else:
            assert report[2] == wanted, name


def subsystem_of(vehicle: Vehicle, bits: dict[str, int]) -> dict[int, int]:
    """Says SYS_STATUS with these sensors, and gives the subsystem states that are told because of it."""
    named = {f"onboard_control_sensors_{name}": value & 0xFFFFFFFF for name, value in bits.items()}
    named |= {f"onboard_control_sensors_{name}_extended": value >> 32 for name, value in bits.items()}
    rest = dict.fromkeys("load voltage_battery drop_rate_comm errors_comm".split(), 0)
    counts = {f"errors_count{number}": 0 for number in (1, 2, 3, 4)}
    sample = {"sys_status": named | rest | counts | {"current_battery": -1, "battery_remaining": -1}}
    vehicle.say("sys_status", **vehicle.carried(sample)["sys_status"])
    reports = told(vehicle.answers(), SUBSYSTEM_REPORT)
    assert all(report.keys() == {2, 3, 4} and report[4] == flight_status.NO_REPORT for report in reports)
    return {report[2]: report[3] for report in reports}


@DIALECTS
@pytest.mark.parametrize("armed", [False, True], ids=["disarmed", "armed"])
def test_every_sensor_bit_reaches_its_subsystem(start_vsm: StartVsm, dialect: ModuleType, armed: bool) -> None:
    """One sensor after the other fails and recovers; then sensors at random are fitted, enabled and healthy."""
    vehicle = meet(start_vsm, dialect)
    vehicle.say("heartbeat", QUADROTOR, ARDUPILOT, 128 if armed else 0, 0, 3, 3)
    seed = seed_or(DEFAULT_SEED)
    source = random.Random(seed)
    known_bits = [bit for bit in flight_status.SUBSYSTEM_OF_BIT if bit < 32 or dialect is dialect_v2]
    everything = sum(1 << bit for bit in known_bits) | 1 << flight_status.EXTENDED_BITS_USED
    cases = [(everything, everything, everything)]
    for bit in known_bits:
        cases += [(everything, everything, everything & ~(1 << bit)), (everything, everything, everything)]
    for _ in range(40):
        cases.append((everything & source.getrandbits(33), everything & source.getrandbits(33), source.getrandbits(33)))
    now: dict[int, int] = {}
    for present, enabled, health in cases:
        in_use = 1 << flight_status.EXTENDED_BITS_USED
        bits = {"present": present | in_use, "enabled": enabled | in_use, "health": health | in_use}
        wanted = flight_status.subsystem_states(*bits.values(), armed)
        for subsystem in now.keys() - wanted.keys():
            wanted[subsystem] = flight_status.NO_STATUS
        now |= subsystem_of(vehicle, bits)
        assert now == wanted, f"PONTE_SEED={seed}: {bits}"


@DIALECTS
def test_a_state_of_emergency_is_a_condition_of_the_vehicle(start_vsm: StartVsm, dialect: ModuleType) -> None:
    vehicle = meet(start_vsm, dialect)
    for system_status, wanted in ((5, flight_status.WARNING), (6, flight_status.EMERGENCY)):
        vehicle.say("heartbeat", QUADROTOR, ARDUPILOT, 129, 0, system_status, 3)
        (report,) = told(vehicle.answers(), SUBSYSTEM_REPORT)
        assert report[3] == wanted
    vehicle.say("heartbeat", QUADROTOR, ARDUPILOT, 129, 0, 4, 3)
    (report,) = told(vehicle.answers(), SUBSYSTEM_REPORT)
    assert report[3] <= flight_status.NOMINAL


def alerts(vehicle: Vehicle) -> list[dict[int, Any]]:
    return told(vehicle.answers(), ALERT)


@DIALECTS
def test_every_text_becomes_an_alert(start_vsm: StartVsm, dialect: ModuleType) -> None:
    vehicle = meet(start_vsm, dialect)
    seen: dict[int, str] = {}
    for index, (text, subsystem) in enumerate(flight_status.TEXTS.items()):
        severity = index % 7
        priority = flight_status.PRIORITY_OF_SEVERITY[severity]
        passing = priority <= flight_status.CAUTION
        for repeated in (False, True):
            vehicle.say("statustext", severity, text.encode())
            (alert,) = alerts(vehicle)
            identity = alert.pop(11)
            assert (identity > 0) == repeated, "the first instance carries the negative of its id"
            wanted = {3: priority, 4: flight_status.NO_REPORT, 5: subsystem, 12: text}
            wanted[10] = flight_status.TIMED if passing else flight_status.CLEARABLE
            if passing:
                wanted[13] = flight_status.PERSISTENCE_S
            assert alert == wanted, f"severity {severity}, {text!r}"
            assert seen.setdefault(abs(identity), text) == text, "two texts share an id"
    vehicle.say("statustext", 7, b"debug")
    assert alerts(vehicle) == []


def test_long_texts_are_put_together_and_cut(start_vsm: StartVsm) -> None:
    vehicle = meet(start_vsm, dialect_v2)
    text = "".join(chr(ord("a") + index % 26) for index in range(120))
    for chunk in range(3):
        vehicle.say("statustext", 4, text[50 * chunk : 50 * chunk + 50].encode(), 7, chunk)
    (alert,) = alerts(vehicle)
    assert alert[12] == text[: flight_status.TEXT_SIZE_MAX]


def autopilot_version(vehicle: Vehicle, serial: int) -> dict[str, Any]:
    """AUTOPILOT_VERSION of the hardware with this serial number."""
    versions = dict.fromkeys("flight_sw_version middleware_sw_version os_sw_version board_version".split(), 0)
    custom = {f"{part}_custom_version": [0] * 8 for part in ("flight", "middleware", "os")}
    hardware = {"vendor_id": 0, "product_id": 0, "uid": serial, "uid2": [serial] + [0] * 17}
    sample = {"autopilot_version": {"capabilities": 0, **versions, **custom, **hardware}}
    return vehicle.carried(sample)["autopilot_version"]


@DIALECTS
def test_a_vehicle_tells_who_it_is(start_vsm: StartVsm, dialect: ModuleType) -> None:
    identity = ("--owning-id", "26", "--vsm-id", "77", "--vehicle-type", "32", "--call-sign", "ROOK 1")
    vehicle = meet(start_vsm, dialect, *identity)
    names = set()
    for serial in (1, 2):
        vehicle.say("autopilot_version", **autopilot_version(vehicle, serial))
        message = vehicle.receiver.next(VEHICLE_ID)
        fields = told([message], VEHICLE_ID)[0]
        names.add(fields.pop(7))
        own_id = message.wrapped.source
        assert own_id >> 24 == 26
        assert fields == {2: identifier("1A:60:00:4D"), 3: own_id, 4: 32, 5: QUADROTOR, 6: 26, 9: "ROOK 1"}
    assert len(names - {""}) == 2, "each serial number is a tail number of its own"


def test_a_configured_tail_number_wins(start_vsm: StartVsm) -> None:
    vehicle = meet(start_vsm, dialect_v2, "--tail-number", "PT-001")
    vehicle.say("autopilot_version", **autopilot_version(vehicle, 1))
    assert told(vehicle.answers(), VEHICLE_ID)[-1][7] == "PT-001"


def test_samples_carry_the_autopilots_time(start_vsm: StartVsm) -> None:
    """SYSTEM_TIME ties time since boot to UTC; a time stamp is in milliseconds since 2000."""
    vehicle = meet(start_vsm, dialect_v2)
    year_2000 = 946_684_800_000
    seed = seed_or(DEFAULT_SEED)
    source = random.Random(seed)
    boot_ms = 1000
    offset_ms = int(time.time() * 1000) + source.randint(1, 3_600_000)
    for _ in range(20):
        boot_ms += source.randint(1, 1000)
        vehicle.say("system_time", (offset_ms + boot_ms) * 1000, boot_ms)
        vehicle.say("attitude", boot_ms, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0)
        stamp = raws(vehicle.receiver.next(4000))[1]
        assert abs(stamp - (offset_ms + boot_ms - year_2000)) <= 1, f"PONTE_SEED={seed}"


def test_a_silent_vehicle_has_no_mode_and_raises_alerts(start_vsm: StartVsm) -> None:
    vehicle = meet(start_vsm, dialect_v2)
    vehicle.say("heartbeat", QUADROTOR, ARDUPILOT, 81, 3, 3, 3)
    vehicle.answers()
    heard = vehicle.receiver.until(
        lambda message: message.number == ALERT and message.fields[3].raw == flight_status.EMERGENCY
    )
    wanted = [(flight_status.WARNING, flight_status.COMMS), (flight_status.EMERGENCY, flight_status.COMMS)]
    assert [(alert[3], alert[5]) for alert in told(heard, ALERT)] == wanted
    assert any(message.number == HEARTBEAT for message in heard), "the VSM itself is alive"
    assert told([vehicle.receiver.next(MODE_REPORT)], MODE_REPORT) == [{2: flight_status.NO_MODE}]
    assert told([vehicle.receiver.next(OPERATING_STATES)], OPERATING_STATES) == [{17: flight_status.UNKNOWN_STATE}]
