"""Frames of MAVLink 0.9, written and read apart from Ponte: no peer has a working 0.9.

Wire rules: start byte 0x55, payload length, sequence, system, component, id; fields most significant byte first in the
order of the definition; checksum X.25 from the length to the payload, low byte first, with no seed of the message.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from typing import Any, NamedTuple

START = 0x55
MANUAL, GUIDED, AUTO = 2, 3, 4  # MAV_MODE
GROUNDED, WAYPOINT, LANDING = 0, 3, 6  # MAV_NAV
STANDBY, ACTIVE = 3, 4  # MAV_STATE
MOTORS_START, LAUNCH, LAND = 1, 2, 26  # MAV_ACTION

# Name: id, layout, names of the fields.
MESSAGES: dict[str, tuple[int, str, str]] = {
    "HEARTBEAT": (0, "BBB", "type autopilot mavlink_version"),
    "ACTION_ACK": (9, "BB", "action result"),
    "ACTION": (10, "BBB", "target target_component action"),
    "SET_MODE": (11, "BB", "target mode"),
    "ATTITUDE": (30, "Q6f", "usec roll pitch yaw rollspeed pitchspeed yawspeed"),
    "SYS_STATUS": (34, "3B4H", "mode nav_mode status load vbat battery_remaining packet_drop"),
    "REQUEST_DATA_STREAM": (
        66, "3BHB", "target_system target_component req_stream_id req_message_rate start_stop",
    ),
    "GLOBAL_POSITION_INT": (73, "3i3h", "lat lon alt vx vy vz"),
    "VFR_HUD": (74, "2fhH2f", "airspeed groundspeed heading throttle alt climb"),
    "STATUSTEXT": (254, "B50s", "severity text"),
}  # fmt: skip
BY_ID = {number: name for name, (number, _, _) in MESSAGES.items()}


class Frame(NamedTuple):
    """One frame, with its fields if the message is one of those above."""

    system: int
    component: int
    sequence: int
    number: int
    name: str | None
    fields: dict[str, Any]


def checksum(covered: bytes) -> int:
    """X.25, bit by bit."""
    crc = 0xFFFF
    for byte in covered:
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ (0x8408 if crc & 1 else 0)
    return crc


def pack(name: str, *values: Any, sequence: int = 0, system: int = 1, component: int = 1) -> bytes:
    """A frame with these values of the fields, in their order."""
    number, layout, _ = MESSAGES[name]
    payload = struct.pack(">" + layout, *values)
    covered = bytes([len(payload), sequence, system, component, number]) + payload
    return bytes([START]) + covered + struct.pack("<H", checksum(covered))


def unpack(stream: bytes) -> Iterator[Frame]:
    """The frames of a stream that holds nothing else."""
    while stream:
        assert stream[0] == START, stream.hex()
        end = 6 + stream[1]
        assert struct.unpack_from("<H", stream, end)[0] == checksum(stream[1:end]), stream.hex()
        _, _, sequence, system, component, number = stream[:6]
        name = BY_ID.get(number)
        fields: dict[str, Any] = {}
        if name is not None:
            _, layout, names = MESSAGES[name]
            fields = dict(zip(names.split(), struct.unpack(">" + layout, stream[6:end]), strict=True))
        yield Frame(system, component, sequence, number, name, fields)
        stream = stream[end + 2 :]
