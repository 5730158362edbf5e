"""MAVLink 0.9 through the programs, against frames that are written and read apart from Ponte."""

from __future__ import annotations

import random
import socket
import struct
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import flight_maths
import mavlink_v09 as v09
import tlog
from dli_reader import Message
from programs import json_objects, seed_or
from test_random_attitudes import random_attitude
from vsm_bench import DliReceiver, Udp, assert_near, raws

PATIENCE_S = 60.0
START_US = 1_700_000_000_000_000
DEFAULT_SEED = 90
INERTIAL_STATES = 4000

StartPonte = Callable[..., None]  # the fixture of conftest.py: the arguments


def float32(value: float) -> float:
    return float(struct.unpack("<f", struct.pack("<f", value))[0])


def test_translate_reads_a_recording(ponte: Path, tmp_path: Path) -> None:
    source = random.Random(seed_or(DEFAULT_SEED))
    attitudes = [random_attitude(source) for _ in range(200)]
    frames = [(START_US, v09.pack("HEARTBEAT", 2, 3, 2))]
    for index, attitude in enumerate(attitudes):
        frame = v09.pack("ATTITUDE", index * 20_000, *attitude, sequence=(index + 1) % 256)
        frames.append((START_US + index * 20_000, frame))
    tlog.write_log(tmp_path / "old.tlog", iter(frames))
    told = [
        message["fields"]
        for message in json_objects([ponte, "translate", tmp_path / "old.tlog", "--json"])
        if message["number"] == INERTIAL_STATES
    ]
    assert len(told) == len(attitudes)
    for fields, attitude in zip(told, attitudes, strict=True):
        wanted = flight_maths.attitude_fields(*(float32(value) for value in attitude))
        names = {12: "roll", 13: "pitch", 14: "heading"}
        for number, name in names.items():
            assert abs(fields[name]["raw"] - wanted[number]) <= 1, (name, attitude)


class OldVehicle:
    """An autopilot of 2011 on a UDP port."""

    def __init__(self, carrier: Udp) -> None:
        self.carrier = carrier
        self.sequence = 0

    def say(self, name: str, *values: Any) -> None:
        self.carrier.send(v09.pack(name, *values, sequence=self.sequence))
        self.sequence = (self.sequence + 1) % 256

    def heard(self) -> Iterator[v09.Frame]:
        """What the VSM says to it, for ever."""
        self.carrier.socket.settimeout(PATIENCE_S)
        while True:
            yield from v09.unpack(self.carrier.socket.recv(2048))

    def appear(self, receiver: DliReceiver) -> Message:
        receiver.next(16002)
        deadline = time.monotonic() + PATIENCE_S
        while time.monotonic() < deadline:
            self.say("HEARTBEAT", 2, 3, 2)
            try:
                return receiver.next(3, patience_s=1.0)
            except TimeoutError:
                continue
        raise AssertionError("the VSM has not noticed the vehicle")


def test_vsm_hears_an_old_vehicle_and_answers_in_its_version(start_ponte: StartPonte) -> None:
    receiver, carrier = DliReceiver(), Udp()
    start_ponte(
        "vsm", "--vehicle", carrier.endpoint, "--dli", f"udpout://127.0.0.1:{receiver.port}", "--every-sample"
    )
    vehicle = OldVehicle(carrier)
    vehicle.appear(receiver)
    asked: set[int] = set()
    for frame in vehicle.heard():
        if frame.name == "REQUEST_DATA_STREAM":
            assert (frame.fields["target_system"], frame.fields["start_stop"]) == (1, 1)
            asked.add(frame.fields["req_stream_id"])
        if {6, 10, 11} <= asked and frame.name == "HEARTBEAT":
            assert (frame.fields["type"], frame.fields["autopilot"], frame.fields["mavlink_version"]) == (6, 4, 2)
            break

    source = random.Random(seed_or(DEFAULT_SEED))
    for index in range(50):
        attitude = random_attitude(source)
        place = (source.randint(-900_000_000, 900_000_000), source.randint(-1_800_000_000, 1_799_999_999))
        altitude, speed = source.randint(-500_000, 9_000_000), [source.randint(-5000, 5000) for _ in range(3)]
        vehicle.say("GLOBAL_POSITION_INT", *place, altitude, speed[0], speed[1], -speed[2])  # z is up
        vehicle.say("ATTITUDE", index * 100_000, *attitude)
        got: dict[int, Any] = {}
        while 12 not in got:
            got |= raws(receiver.next(INERTIAL_STATES))
        got.pop(1)
        wanted = flight_maths.attitude_fields(*(float32(value) for value in attitude))
        wanted |= flight_maths.position_fields(*place, altitude, *speed)
        assert_near(INERTIAL_STATES, got, wanted, f"sample {index}")


def test_sim_is_an_autopilot_of_2011(start_ponte: StartPonte) -> None:
    station = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    station.bind(("127.0.0.1", 0))
    station.settimeout(PATIENCE_S)
    place = f"udpout://127.0.0.1:{station.getsockname()[1]}"
    start_ponte("sim", "--mavlink", "0.9", "--speedup", "10", "--endpoint", place)
    address: Any = None

    def until(is_last: Callable[[v09.Frame], bool]) -> v09.Frame:
        nonlocal address
        while True:
            datagram, address = station.recvfrom(4096)
            for frame in v09.unpack(datagram):
                if is_last(frame):
                    return frame

    def say(name: str, *values: Any) -> None:
        station.sendto(v09.pack(name, *values, system=255), address)

    def has_status(mode: int, nav_mode: int, status: int) -> Callable[[v09.Frame], bool]:
        wanted = (mode, nav_mode, status)
        return lambda frame: frame.name == "SYS_STATUS" and tuple(frame.fields.values())[:3] == wanted

    heartbeat = until(lambda frame: frame.name == "HEARTBEAT")
    assert heartbeat.fields == {"type": 2, "autopilot": 3, "mavlink_version": 2}
    say("REQUEST_DATA_STREAM", 1, 1, 0, 4, 1)
    until(has_status(v09.MANUAL, v09.GROUNDED, v09.STANDBY))
    while True:  # it refuses until it knows where it is
        say("ACTION", 1, 1, v09.MOTORS_START)
        answer = until(lambda frame: frame.name == "ACTION_ACK")
        assert answer.fields["action"] == v09.MOTORS_START
        if answer.fields["result"] == 1:
            break
    say("SET_MODE", 1, v09.GUIDED)
    say("ACTION", 1, 1, v09.LAUNCH)
    assert until(lambda frame: frame.name == "ACTION_ACK").fields == {"action": v09.LAUNCH, "result": 1}
    until(lambda frame: frame.name == "GLOBAL_POSITION_INT" and frame.fields["vz"] > 50)  # up
    say("ACTION", 1, 1, v09.LAND)
    assert until(lambda frame: frame.name == "ACTION_ACK").fields == {"action": v09.LAND, "result": 1}
    until(has_status(v09.AUTO, v09.LANDING, v09.ACTIVE))
    until(lambda frame: frame.name == "SYS_STATUS" and frame.fields["status"] == v09.STANDBY)
