"""A live `ponte vsm` between pymavlink and the independent DLI reader.

Everything goes in step: the next message is sent when the answer to the last one has arrived, so nothing here depends on
how fast the machine is.
"""

from __future__ import annotations

import os
import pty
import select
import socket
import struct
import time
from collections.abc import Callable
from types import ModuleType
from typing import Any

import pytest
from pymavlink.dialects.v10 import ardupilotmega as dialect_v1
from pymavlink.dialects.v20 import ardupilotmega as dialect_v2

import flight_maths
from dli_reader import Message, decode_datagram
from dli_tables import tables

PATIENCE_S = 60.0
GROUP = "239.255.45.86"
QUADROTOR, FIXED_WING = 2, 1  # MAV_TYPE
ARDUPILOT, PX4 = 3, 12  # MAV_AUTOPILOT
DIALECTS = pytest.mark.parametrize("dialect", [dialect_v1, dialect_v2], ids=["mavlink1", "mavlink2"])

StartVsm = Callable[..., None]  # the fixture of conftest.py: where vehicles are, where stations are, options


class DliReceiver:
    """A UDP socket that datagrams of the VSM arrive on, one message each."""

    def __init__(self, group: str | None = None) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.bind(("127.0.0.1" if group is None else "", 0))
        self.port: int = self.socket.getsockname()[1]
        if group is not None:
            membership = struct.pack("4s4s", socket.inet_aton(group), socket.inet_aton("127.0.0.1"))
            self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)

    def until(self, is_last: Callable[[Message], bool], patience_s: float = PATIENCE_S) -> list[Message]:
        """All messages up to the one that is the last. The patience ends a test that would hang; it judges no speed."""
        heard: list[Message] = []
        deadline = time.monotonic() + patience_s
        while not heard or not is_last(heard[-1]):
            self.socket.settimeout(max(deadline - time.monotonic(), 0.001))
            heard.extend(decode_datagram(self.socket.recv(2048), "3"))
        return heard

    def next(self, number: int, patience_s: float = PATIENCE_S) -> Message:
        """The next message of this number; others are read and put aside."""
        return self.until(lambda message: message.number == number, patience_s)[-1]


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


class Vehicle:
    """What an autopilot sends, over any carrier, and a ground station that talks to it beside us."""

    def __init__(self, carrier: Any, dialect: ModuleType, receiver: DliReceiver) -> None:
        self.carrier = carrier
        self.dialect = dialect
        self.receiver = receiver
        self.link = dialect.MAVLink(None, srcSystem=1, srcComponent=1)
        self.station = dialect.MAVLink(None, srcSystem=255, srcComponent=190)
        self.marks = 0

    def frame(self, name: str, *values: Any, by_station: bool = False, **named: Any) -> bytes:
        """One message, packed."""
        link = self.station if by_station else self.link
        frame = bytes(getattr(self.dialect, f"MAVLink_{name}_message")(*values, **named).pack(link))
        link.seq = (link.seq + 1) % 256
        return frame

    def say(self, name: str, *values: Any, by_station: bool = False, **named: Any) -> None:
        self.carrier.send(self.frame(name, *values, by_station=by_station, **named))

    def carried(self, sample: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
        """What is left of messages in this dialect: MAVLink 1 ends at id 255 and has no extension fields."""
        classes = {name: getattr(self.dialect, f"MAVLink_{name}_message", None) for name in sample}
        return {
            name: {key: value for key, value in values.items() if key in classes[name].fieldnames}
            for name, values in sample.items()
            if classes[name]
        }

    def appear(self, airframe: int = QUADROTOR, autopilot: int = ARDUPILOT) -> Message:
        """Waits for the VSM's heartbeat, once a second, and shows itself until the VSM tells of it in a #3."""
        self.receiver.next(16002)
        for _ in range(int(PATIENCE_S)):
            self.say("heartbeat", airframe, autopilot, 81, 0, 3, 3)
            try:
                return self.receiver.next(3, patience_s=1.0)
            except TimeoutError:
                continue
        pytest.fail("the VSM has not noticed the vehicle")

    def answers(self) -> list[Message]:
        """What the VSM told because of all that was said up to now: a text said last is told last, as an alert."""
        self.marks += 1
        text = f"answered {self.marks}"
        self.say("statustext", 6, text.encode())
        return self.receiver.until(lambda message: message.number == 16000 and message.fields[12].raw == text)[:-1]


def meet(
    start_vsm: StartVsm,
    dialect: ModuleType,
    *options: str,
    airframe: int = QUADROTOR,
    autopilot: int = ARDUPILOT,
) -> Vehicle:
    """A vehicle on UDP that a VSM has noticed, with all read that was said of it at first; options are the VSM's."""
    receiver = DliReceiver()
    carrier = Udp()
    start_vsm(carrier.endpoint, f"udpout://127.0.0.1:{receiver.port}", *options)
    vehicle = Vehicle(carrier, dialect, receiver)
    vehicle.appear(airframe, autopilot)
    vehicle.answers()
    return vehicle


def raws(message: Message) -> dict[int, Any]:
    return {number: value.raw for number, value in message.fields.items()}


def assert_near(number: int, got: dict[int, Any], wanted: dict[int, int], where: str) -> None:
    """The same fields of message `number`, each within one unit of its scale; binary angles turn round."""
    fields = tables("3")[number].fields
    assert got.keys() == wanted.keys(), f"{where}: #{number} has fields {sorted(got)}, must have {sorted(wanted)}"
    for place, raw in wanted.items():
        field = fields[place]
        is_angle = field.kind == "b"
        difference = flight_maths.angle_difference(got[place], raw, field.width) if is_angle else got[place] - raw
        assert abs(difference) <= 1, f"{where}: #{number} field {place} {field.name} is {got[place]}, must be {raw}"
