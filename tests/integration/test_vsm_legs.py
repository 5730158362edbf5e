"""Every field of #4001 From-To-Next Waypoint States, from missions that the VSM overhears."""

from __future__ import annotations

import math
import random
import struct
import time
from collections.abc import Callable
from types import ModuleType
from typing import Any, NamedTuple

import pytest
from pymavlink.dialects.v20 import ardupilotmega as dialect_v2

import flight_maths
from flight_status import AUTOLAND, LAUNCH
from flight_status import WAYPOINT as WAYPOINT_MODE
from programs import seed_or
from vsm_bench import ARDUPILOT, DIALECTS, FIXED_WING, QUADROTOR
from vsm_bench import StartVsm, Vehicle, assert_near, meet, raws

DEFAULT_SEED = 43
LEG, VEHICLE_ID, MODE_REPORT = 4001, 3, 3001
AUTO = {QUADROTOR: 3, FIXED_WING: 10}
GUIDED = 4
ARMED = 128  # in base_mode
AUTOPILOT, STATION = (1, 1), (255, 190)  # system and component
YEAR_2000_MS = 946_684_800_000
WAYPOINT, TAKE_OFF, LAND, JUMP, CHANGE_SPEED = 16, 22, 21, 177, 178
OVER_SEA, OVER_HOME, OVER_TERRAIN, NO_PLACE = 0, 3, 10, 2
FROM, TO, NEXT = (4, 5, 6, 8), (9, 10, 11, 14), (15, 16, 17, 20)


class Item(NamedTuple):
    """An item of a mission, with its place in degrees times 10^7 and its height in metres."""

    command: int
    frame: int
    x: int = 0
    y: int = 0
    z: float = 0.0
    params: tuple[float, float] = (0.0, 0.0)


def random_mission(r: random.Random) -> list[Item]:
    """Home, take-off, waypoints in all frames with a change of speed between them, a jump back, and a landing."""

    def at(command: int, frame: int) -> Item:
        place = r.randint(-800_000_000, 800_000_000), r.randint(-1_700_000_000, 1_700_000_000)
        return Item(command, frame, *place, float(r.randint(1, 4000)))

    return [
        at(WAYPOINT, OVER_SEA), at(TAKE_OFF, OVER_HOME), at(WAYPOINT, OVER_HOME), Item(CHANGE_SPEED, NO_PLACE),
        at(WAYPOINT, OVER_SEA), Item(JUMP, NO_PLACE, params=(2.0, -1.0)), at(WAYPOINT, OVER_TERRAIN),
        at(LAND, OVER_HOME),
    ]  # fmt: skip


# What lies behind each item that can be flown to; the speed is no place, the jump leads back, nothing follows landing.
FOLLOWING = {1: 2, 2: 4, 4: 2, 6: 7, 7: None}


def waypoint(numbers: tuple[int, int, int, int], sequence: int, item: Item, home_m: float | None) -> dict[int, int]:
    """The fields of a waypoint; its height where it can be told as altitude type 3, above the sea."""
    latitude, longitude, altitude, number = numbers
    fields = {number: sequence}
    fields |= {latitude: flight_maths.bam4_from_deg_e7(item.x), longitude: flight_maths.bam4_from_deg_e7(item.y)}
    base = {OVER_SEA: 0.0, OVER_HOME: home_m}.get(item.frame)
    if base is not None:
        fields[altitude] = flight_maths.round_half_away((base + item.z) / 0.02)
        fields[2] = flight_maths.ALTITUDE_TYPE_WGS84
    return fields


def leg(mission: list[Item], reached: int | None, current: int, home_m: float | None) -> dict[int, int]:
    fields: dict[int, int] = {}
    for numbers, sequence in ((FROM, reached), (TO, current), (NEXT, FOLLOWING[current])):
        if sequence is not None:
            fields |= waypoint(numbers, sequence, mission[sequence], home_m)
    return fields


def meet_in_auto(start_vsm: StartVsm, dialect: ModuleType, airframe: int) -> Vehicle:
    vehicle = meet(start_vsm, dialect, airframe=airframe)
    vehicle.say("heartbeat", airframe, ARDUPILOT, 1, AUTO[airframe], 3, 3)
    vehicle.answers()
    return vehicle


@pytest.fixture
def vehicle(start_vsm: StartVsm, dialect: ModuleType) -> Vehicle:
    return meet_in_auto(start_vsm, dialect, QUADROTOR)


def send_items(vehicle: Vehicle, mission: list[Item], target: tuple[int, int], by_station: bool) -> None:
    vehicle.say("mission_count", *target, len(mission), by_station=by_station)
    for sequence, item in enumerate(mission):
        place = (*item.params, 0.0, 0.0, item.x, item.y, item.z)
        values = (*target, sequence, item.frame, item.command, 0, 1, *place)
        vehicle.say("mission_item_int", *values, by_station=by_station)


def upload(vehicle: Vehicle, mission: list[Item]) -> None:
    """A ground station gives the mission to the vehicle, which takes it."""
    send_items(vehicle, mission, AUTOPILOT, by_station=True)
    vehicle.say("mission_ack", *STATION, 0)


def download(vehicle: Vehicle, mission: list[Item]) -> None:
    """A ground station asks for the mission that the vehicle has."""
    vehicle.say("mission_request_list", *AUTOPILOT, by_station=True)
    send_items(vehicle, mission, STATION, by_station=False)
    vehicle.say("mission_ack", *AUTOPILOT, 0, by_station=True)


def last_leg(vehicle: Vehicle) -> dict[int, Any]:
    """The last #4001 that came of what was said, without its time."""
    fields = [raws(message) for message in vehicle.answers() if message.number == LEG][-1]
    fields.pop(1)
    return fields


def since_2000_ms() -> float:
    return time.time() * 1000 - YEAR_2000_MS


@pytest.mark.parametrize("transfer", [upload, download])
@pytest.mark.parametrize("with_home", [False, True], ids=["no home", "home known"])
@DIALECTS
def test_every_leg_is_told(
    vehicle: Vehicle, with_home: bool, transfer: Callable[[Vehicle, list[Item]], None]
) -> None:
    seed = seed_or(DEFAULT_SEED)
    r = random.Random(seed)
    mission = random_mission(r)
    home_m = r.randint(-400_000, 4_000_000) / 1000 if with_home else None
    if home_m is not None:
        vehicle.say("home_position", 1, 1, round(home_m * 1000), 0.0, 0.0, 0.0, [1.0, 0.0, 0.0, 0.0], 0.0, 0.0, 0.0)
    elif transfer is download:
        home_m = mission[0].z  # item 0 of an ArduPilot's own mission is its home; in an upload it is a placeholder
    transfer(vehicle, mission)
    vehicle.say("mission_current", 1)
    assert_near(LEG, last_leg(vehicle), leg(mission, None, 1, home_m), f"PONTE_SEED={seed}, before any item")
    for reached, current in ((1, 2), (2, 4), (4, 2), (2, 4), (4, 6), (6, 7)):
        before = since_2000_ms()
        vehicle.say("mission_item_reached", reached)
        vehicle.say("mission_current", current)
        got = last_leg(vehicle)
        assert before - 1 <= got.pop(7) <= since_2000_ms() + 1, "the time at which the last waypoint was reached"
        assert_near(LEG, got, leg(mission, reached, current, home_m), f"PONTE_SEED={seed}, {reached} to {current}")


@DIALECTS
def test_the_time_of_arrival_follows_from_distance_and_speed(vehicle: Vehicle) -> None:
    seed = seed_or(DEFAULT_SEED)
    r = random.Random(seed)
    upload(vehicle, random_mission(r))
    auto, sequence = AUTO[QUADROTOR], 2
    for mode, speed_cm in ((auto, 500), (auto, 4000), (auto, 20), (GUIDED, 500), (auto, 1000)):
        north, east = round(speed_cm * 0.6), round(-speed_cm * 0.8)
        distance = r.randint(1, 5000)
        vehicle.say("heartbeat", QUADROTOR, ARDUPILOT, 1, mode, 3, 3)
        vehicle.say("vfr_hud", 0.0, speed_cm / 100, 0, 50, 100.0, 0.0)
        vehicle.say("global_position_int", 0, 400_000_000, -80_000_000, 0, 0, north, east, 0, 65535)
        before = since_2000_ms()
        vehicle.say("nav_controller_output", 0.0, 0.0, 0, 0, distance, 0.0, 0.0, 0.0)
        vehicle.say("mission_current", sequence := 6 - sequence)
        legs = [raws(message) for message in vehicle.answers() if message.number == LEG]
        times = [fields[13] for fields in legs if 13 in fields]
        where = f"PONTE_SEED={seed}, {distance} m at {speed_cm} cm/s in mode {mode}"
        if mode != auto or speed_cm < 50:
            assert times == [], f"{where}: it would never arrive, or goes elsewhere"
            continue
        duration = distance / (math.hypot(north, east) / 100) * 1000
        assert times, where
        assert all(before + duration - 1 <= one <= since_2000_ms() + duration + 1 for one in times), where


@pytest.mark.parametrize("dialect", [dialect_v2], ids=["mavlink2"])
def test_the_mission_has_an_id(vehicle: Vehicle) -> None:
    """MISSION_CURRENT.mission_id, an extension that pymavlink does not know: 0 is no mission, others only compare."""

    def tell(mission_id: int) -> str | None:
        current = dialect_v2.MAVLink_mission_current_message(1)
        payload = struct.pack("<HHBBI", 1, 0, 0, 0, mission_id)
        vehicle.carrier.send(bytes(current._pack(vehicle.link, current.crc_extra, payload)))
        vehicle.link.seq = (vehicle.link.seq + 1) % 256
        reports = [message for message in vehicle.answers() if message.number == VEHICLE_ID]
        return raws(reports[-1] if reports else vehicle.receiver.next(VEHICLE_ID)).get(8)

    first, none, second, again = tell(0x12345678), tell(0), tell(0x12345679), tell(0x12345678)
    assert first and second and first != second
    assert none is None
    assert again == first


@pytest.mark.parametrize("airframe", [QUADROTOR, FIXED_WING], ids=["copter", "plane"])
@DIALECTS
def test_the_mission_decides_what_auto_means(
    start_vsm: StartVsm, dialect: ModuleType, airframe: int
) -> None:
    """A copter's take-off and a plane's landing are modes of their own in the DLI."""
    vehicle = meet_in_auto(start_vsm, dialect, airframe)
    upload(vehicle, random_mission(random.Random(seed_or(DEFAULT_SEED))))
    first, last = (LAUNCH, WAYPOINT_MODE) if airframe == QUADROTOR else (WAYPOINT_MODE, AUTOLAND)
    vehicle.say("heartbeat", airframe, ARDUPILOT, ARMED | 1, AUTO[airframe], 4, 3)
    mode = WAYPOINT_MODE
    for current, wanted in ((1, first), (4, WAYPOINT_MODE), (7, last), (2, WAYPOINT_MODE)):
        vehicle.say("mission_current", current)
        for message in vehicle.answers():
            if message.number == MODE_REPORT:
                mode = raws(message)[2]
        assert mode == wanted, f"item {current}"
