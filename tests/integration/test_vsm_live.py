"""pymavlink talks to `ponte vsm` over UDP, TCP and a serial line; the independent reader judges the DLI datagrams.

Everything goes in step: the next message is sent when the answer to the last one has arrived, so nothing here depends on
how fast the machine is.
"""

from __future__ import annotations

import os
import pty
import random
import select
import socket
import struct
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from pymavlink.dialects.v10 import ardupilotmega as dialect_v1
from pymavlink.dialects.v20 import ardupilotmega as dialect_v2

import flight_maths
from dli_reader import Message, decode_datagram
from programs import seed_or
from test_random_attitudes import random_attitude

COUNT = 100
DEFAULT_SEED = 40
PATIENCE_S = 60.0
INERTIAL_STATES = 4000
AIR_AND_GROUND = 3009
GROUP = "239.255.45.86"


class DliReceiver:
    """A UDP socket that datagrams of the VSM arrive on, one message each."""

    def __init__(self, group: str | None = None) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.bind(("127.0.0.1" if group is None else "", 0))
        self.socket.settimeout(PATIENCE_S)
        self.port: int = self.socket.getsockname()[1]
        if group is not None:
            membership = struct.pack("4s4s", socket.inet_aton(group), socket.inet_aton("127.0.0.1"))
            self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)

    def next(self, number: int, wanted: Callable[[Message], bool] = lambda _: True) -> Message:
        """The next message of this number that is wanted; others are read and put aside."""
        while True:
            for message in decode_datagram(self.socket.recv(2048), "3"):
                if message.number == number and wanted(message):
                    return message


class Udp:
    def __init__(self) -> None:
        probe = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        probe.bind(("127.0.0.1", 0))
        self.place = probe.getsockname()
        probe.close()
        self.endpoint = f"udpin://127.0.0.1:{self.place[1]}"
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)

    def send(self, frame: bytes) -> None:
        self.socket.sendto(frame, self.place)


class Tcp:
    def __init__(self) -> None:
        self.server = socket.create_server(("127.0.0.1", 0))
        self.server.settimeout(PATIENCE_S)
        self.endpoint = f"tcpout://127.0.0.1:{self.server.getsockname()[1]}"
        self.connection: socket.socket | None = None

    def send(self, frame: bytes) -> None:
        if self.connection is None:
            self.connection, _ = self.server.accept()
        self.connection.sendall(frame)


class SerialLine:
    def __init__(self) -> None:
        self.master, slave = pty.openpty()
        self.slave = slave  # kept open, so that the line does not hang up before the VSM opens it
        self.endpoint = f"serial://{os.ttyname(slave)}:57600"

    def send(self, frame: bytes) -> None:
        os.write(self.master, frame)
        # What the VSM says to the vehicle is read away, or the line would fill up.
        while select.select([self.master], [], [], 0)[0]:
            os.read(self.master, 4096)


@pytest.fixture
def start_vsm(ponte: Path) -> Iterator[Callable[..., None]]:
    """Starts the VSM between two endpoints, and ends it after the test."""
    running: list[subprocess.Popen[bytes]] = []

    def start(vehicle: str, dli: str, *options: str) -> None:
        command = [ponte, "vsm", "--vehicle", vehicle, "--dli", dli, "--every-sample", "--listen-only", *options]
        running.append(subprocess.Popen([str(part) for part in command]))

    yield start
    for process in running:
        assert process.poll() is None, f"the VSM has ended by itself with {process.returncode}"
        process.terminate()
        assert process.wait(PATIENCE_S) == 0


class Vehicle:
    """What an autopilot sends, over any carrier."""

    def __init__(self, carrier: Any, dialect: ModuleType) -> None:
        self.carrier = carrier
        self.dialect = dialect
        self.link = dialect.MAVLink(None, srcSystem=1, srcComponent=1)

    def say(self, name: str, *values: Any) -> None:
        message = getattr(self.dialect, f"MAVLink_{name}_message")(*values)
        self.carrier.send(bytes(message.pack(self.link)))
        self.link.seq = (self.link.seq + 1) % 256

    def appear(self, receiver: DliReceiver) -> None:
        """Waits for the VSM, whose heartbeat comes once a second, and shows itself until the VSM tells of it."""
        receiver.next(16002)
        receiver.socket.settimeout(1.0)
        for _ in range(int(PATIENCE_S)):
            self.say("heartbeat", 2, 3, 81, 0, 3, 3)
            try:
                receiver.next(3)
                break
            except TimeoutError:
                continue
        else:
            pytest.fail("the VSM has not noticed the vehicle")
        receiver.socket.settimeout(PATIENCE_S)


def raws(message: Message) -> dict[int, Any]:
    return {number: value.raw for number, value in message.fields.items()}


def assert_near(got: dict[int, Any], wanted: dict[int, int], where: str) -> None:
    """The same fields, each within one unit of its scale; binary angles turn round."""
    assert got.keys() == wanted.keys(), where
    for number, raw in wanted.items():
        width = {2: 4, 3: 4, 12: 2, 13: 2, 14: 2}.get(number)
        difference = flight_maths.angle_difference(got[number], raw, width) if width else got[number] - raw
        assert abs(difference) <= 1, f"{where}: field {number} is {got[number]}, must be {raw}"


@pytest.mark.parametrize("dialect", [dialect_v1, dialect_v2], ids=["mavlink1", "mavlink2"])
@pytest.mark.parametrize("carrier_type", [Udp, Tcp, SerialLine])
def test_telemetry_becomes_dli_messages(
    start_vsm: Callable[..., None], carrier_type: type, dialect: ModuleType
) -> None:
    seed = seed_or(DEFAULT_SEED)
    source = random.Random(seed)
    receiver = DliReceiver()
    carrier = carrier_type()
    start_vsm(carrier.endpoint, f"udpout://127.0.0.1:{receiver.port}")
    vehicle = Vehicle(carrier, dialect)
    vehicle.appear(receiver)
    for index in range(COUNT):
        where = f"PONTE_SEED={seed}, sample {index}"
        position = (
            source.randint(-900_000_000, 900_000_000),
            source.randint(-1_800_000_000, 1_799_999_999),
            source.randint(-500_000, 9_000_000),
        )
        speed = tuple(source.randint(-5000, 5000) for _ in range(3))
        vehicle.say("global_position_int", index * 100, *position, 0, *speed, 65535)
        attitude = random_attitude(source)
        vehicle.say("attitude", index * 100, *attitude)
        # A position that has waited for 100 ms goes out by itself; either way the fields are there.
        got: dict[int, Any] = {}
        while 12 not in got:
            got |= raws(receiver.next(INERTIAL_STATES))
        assert 0 <= got.pop(1) < 2**40
        sent = [struct.unpack("<f", struct.pack("<f", value))[0] for value in attitude]
        assert_near(got, flight_maths.attitude_fields(*sent) | flight_maths.position_fields(*position, *speed), where)


def test_what_is_unknown_is_absent(start_vsm: Callable[..., None]) -> None:
    receiver = DliReceiver()
    carrier = Udp()
    start_vsm(carrier.endpoint, f"udpout://127.0.0.1:{receiver.port}")
    vehicle = Vehicle(carrier, dialect_v2)
    vehicle.appear(receiver)
    vehicle.say("global_position_int", 0, 0, 0, 0, 0, 0, 0, 0, 65535)
    vehicle.say("attitude", 0, 0.1, float("nan"), 0.2, 0.0, 0.0, 0.0)
    assert raws(receiver.next(INERTIAL_STATES)).keys() == {1, 12, 14}
    vehicle.say("vfr_hud", 0.0, 5.0, 90, 50, 120.0, 1.0)
    got = raws(receiver.next(AIR_AND_GROUND))
    assert got.keys() == {1, 10, 11}, "a copter's airspeed of 0 is no airspeed"
    assert (got[10], got[11]) == (6000, 20)


def test_stations_of_a_group_hear_the_vsm(start_vsm: Callable[..., None]) -> None:
    try:
        receiver = DliReceiver(GROUP)
    except OSError as error:
        pytest.skip(f"this machine has no multicast on its loopback: {error}")
    carrier = Udp()
    start_vsm(carrier.endpoint, f"udpmulticast://{GROUP}:{receiver.port}?interface=lo")
    vehicle = Vehicle(carrier, dialect_v2)
    vehicle.appear(receiver)
    vehicle.say("attitude", 0, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0)
    assert raws(receiver.next(INERTIAL_STATES))[12] == flight_maths.bam2(struct.unpack("<f", struct.pack("<f", 0.1))[0])


def test_the_vehicle_may_go_and_come_back(start_vsm: Callable[..., None]) -> None:
    """A TCP peer that closes its connection: the VSM connects again, and goes on."""
    receiver = DliReceiver()
    carrier = Tcp()
    start_vsm(carrier.endpoint, f"udpout://127.0.0.1:{receiver.port}")
    vehicle = Vehicle(carrier, dialect_v2)
    vehicle.appear(receiver)
    assert carrier.connection is not None
    carrier.connection.close()
    carrier.connection = None
    for attempt in range(int(PATIENCE_S)):
        vehicle.say("heartbeat", 2, 3, 81, 0, 3, 3)
        vehicle.say("attitude", attempt, 0.1 + attempt / 100, 0.2, 0.3, 0.0, 0.0, 0.0)
        receiver.socket.settimeout(1.0)
        try:
            assert raws(receiver.next(INERTIAL_STATES)).keys() >= {1, 12, 13, 14}
            break
        except TimeoutError:
            continue
    else:
        pytest.fail("nothing came after the connection was renewed")
