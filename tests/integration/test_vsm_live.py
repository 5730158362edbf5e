"""pymavlink talks to `ponte vsm` over UDP, TCP and a serial line; the independent reader judges the DLI datagrams.

Everything goes in step: the next message is sent when the answer to the last one has arrived, so nothing here depends on
how fast the machine is.
"""

from __future__ import annotations

import random
import struct
from types import ModuleType
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as dialect_v2

import flight_maths
from programs import seed_or
from test_random_attitudes import random_attitude
from vsm_bench import DIALECTS, GROUP, PATIENCE_S
from vsm_bench import DliReceiver, SerialLine, StartVsm, Tcp, Udp, Vehicle, assert_near, raws

COUNT = 100
DEFAULT_SEED = 40
INERTIAL_STATES = 4000
AIR_AND_GROUND = 3009


@DIALECTS
@pytest.mark.parametrize("carrier_type", [Udp, Tcp, SerialLine])
def test_telemetry_becomes_dli_messages(
    start_vsm: StartVsm, carrier_type: type, dialect: ModuleType
) -> None:
    seed = seed_or(DEFAULT_SEED)
    source = random.Random(seed)
    receiver = DliReceiver()
    carrier = carrier_type()
    start_vsm(carrier.endpoint, f"udpout://127.0.0.1:{receiver.port}")
    vehicle = Vehicle(carrier, dialect, receiver)
    vehicle.appear()
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
        wanted = flight_maths.attitude_fields(*sent) | flight_maths.position_fields(*position, *speed)
        assert_near(INERTIAL_STATES, got, wanted, where)


def test_what_is_unknown_is_absent(start_vsm: StartVsm) -> None:
    receiver = DliReceiver()
    carrier = Udp()
    start_vsm(carrier.endpoint, f"udpout://127.0.0.1:{receiver.port}")
    vehicle = Vehicle(carrier, dialect_v2, receiver)
    vehicle.appear()
    vehicle.say("global_position_int", 0, 0, 0, 0, 0, 0, 0, 0, 65535)
    vehicle.say("attitude", 0, 0.1, float("nan"), 0.2, 0.0, 0.0, 0.0)
    assert raws(receiver.next(INERTIAL_STATES)).keys() == {1, 12, 14}
    vehicle.say("vfr_hud", 0.0, 5.0, 90, 50, 120.0, 1.0)
    got = raws(receiver.next(AIR_AND_GROUND))
    assert got.keys() == {1, 10, 11}, "a copter's airspeed of 0 is no airspeed"
    assert (got[10], got[11]) == (6000, 20)


def test_stations_of_a_group_hear_the_vsm(start_vsm: StartVsm) -> None:
    try:
        receiver = DliReceiver(GROUP)
    except OSError as error:
        pytest.skip(f"this machine has no multicast on its loopback: {error}")
    carrier = Udp()
    start_vsm(carrier.endpoint, f"udpmulticast://{GROUP}:{receiver.port}?interface=lo")
    vehicle = Vehicle(carrier, dialect_v2, receiver)
    vehicle.appear()
    vehicle.say("attitude", 0, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0)
    assert raws(receiver.next(INERTIAL_STATES))[12] == flight_maths.bam2(struct.unpack("<f", struct.pack("<f", 0.1))[0])


def test_the_vehicle_may_go_and_come_back(start_vsm: StartVsm) -> None:
    """A TCP peer that closes its connection: the VSM connects again, and goes on."""
    receiver = DliReceiver()
    carrier = Tcp()
    start_vsm(carrier.endpoint, f"udpout://127.0.0.1:{receiver.port}")
    vehicle = Vehicle(carrier, dialect_v2, receiver)
    vehicle.appear()
    assert carrier.connection is not None
    carrier.connection.close()
    carrier.connection = None
    for attempt in range(int(PATIENCE_S)):
        vehicle.say("heartbeat", 2, 3, 81, 0, 3, 3)
        vehicle.say("attitude", attempt, 0.1 + attempt / 100, 0.2, 0.3, 0.0, 0.0, 0.0)
        try:
            assert raws(receiver.next(INERTIAL_STATES, patience_s=1.0)).keys() >= {1, 12, 13, 14}
            break
        except TimeoutError:
            continue
    else:
        pytest.fail("nothing came after the connection was renewed")
