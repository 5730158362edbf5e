"""Every field of the state messages #3002, #3009, #3010 and #4000: pymavlink sends, `ponte vsm` translates, the
independent reader and the independent calculation judge."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as dialect_v2

import telemetry_maths
from dli_reader import Message
from flight_status import AV_STATES, Life
from programs import seed_or
from telemetry_maths import RULES, Known, Told
from telemetry_samples import SOURCES, batch
from vsm_bench import ARDUPILOT, DIALECTS, FIXED_WING, GROUP, QUADROTOR
from vsm_bench import DliReceiver, SerialLine, StartVsm, Tcp, Udp, Vehicle, assert_near, meet, raws

COUNT = 25
DEFAULT_SEED = 41
STATES = (telemetry_maths.OPERATING, telemetry_maths.AIR, telemetry_maths.BODY, telemetry_maths.INERTIAL)
AIRFRAMES = {"best": QUADROTOR, "second": FIXED_WING, "third": QUADROTOR}
MANUAL_AND_AUTO = {QUADROTOR: (0, 3), FIXED_WING: (0, 10)}
HOME_FROM = COUNT // 4


class Step:
    """What one sample says, and what must become of it."""

    def __init__(self, kind: str, index: int, source: random.Random, known: Known, life: Life) -> None:
        self.said = batch(kind, source)
        if index < HOME_FROM:
            self.said.pop("home_position", None)
        self.airframe = AIRFRAMES[kind]
        known.rotorcraft = self.airframe == QUADROTOR
        known.navigates = source.random() < 0.7
        self.mode = MANUAL_AND_AUTO[self.airframe][known.navigates]
        self.life = source.choice([one for one in AV_STATES if AV_STATES[one] != AV_STATES[life]])

    def tell(self, known: Known) -> list[Told]:
        """What must be told of every field that this sample is a source of."""
        return [one for name, values in self.said.items() for one in RULES[name](values, known)]


def samples(kind: str, seed: int) -> Iterator[tuple[Step, Known]]:
    """The steps of one flight; what is known is carried on from one to the next."""
    source, known, life = random.Random(f"{seed} {kind}"), Known(), Life()
    for index in range(COUNT):
        step = Step(kind, index, source, known, life)
        yield step, known
        life = step.life


def gather(into: dict[int, dict[int, Any]], messages: list[Message]) -> None:
    """Adds fields to what was told of a sample before: a message may go out before the next one has been heard."""
    for message in messages:
        if message.number in STATES:
            into[message.number] |= raws(message)


def fly(vehicle: Vehicle, step: Step, life: Life) -> dict[int, dict[int, Any]]:
    """Says all of one sample and gives the fields of each message that became of it."""
    got: dict[int, dict[int, Any]] = {number: {} for number in STATES}
    imu = [name for name in step.said if name.endswith("_imu")]

    def heartbeat(status: Life) -> None:
        armed = 128 if status.armed else 0
        vehicle.say("heartbeat", step.airframe, ARDUPILOT, armed | 1, step.mode, status.system_status, 3)

    def say(*names: str) -> None:
        for name in names:
            vehicle.say(name, **step.said[name])
        gather(got, vehicle.answers())

    heartbeat(life)
    say("attitude", *imu)
    while imu and not got[telemetry_maths.BODY]:  # inertial samples are taken 20 times a second
        say("attitude", *imu)
    say(*(name for name in step.said if name not in imu and name != "attitude"), "attitude")
    vehicle.say("extended_sys_state", 0, step.life.landed_state)
    heartbeat(step.life)  # a new state of the vehicle calls for a #3002
    gather(got, vehicle.answers())
    return got


def wanted_from(tells: list[Told], step: Step) -> dict[int, dict[int, int]]:
    wanted: dict[int, dict[int, int]] = {number: {} for number in STATES}
    for one in tells:
        if one.raw is not None:
            wanted[one.number][one.field] = one.raw
    wanted[telemetry_maths.OPERATING][17] = AV_STATES[step.life]
    return wanted


def judge(vehicle: Vehicle, kind: str) -> None:
    """Flies all samples of this kind past the VSM."""
    seed = seed_or(DEFAULT_SEED)
    vehicle.appear(AIRFRAMES[kind])
    vehicle.say("extended_sys_state", 0, Life().landed_state)
    vehicle.say("heartbeat", AIRFRAMES[kind], ARDUPILOT, 1, 0, Life().system_status, 3)
    vehicle.answers()
    life = Life()
    for index, (step, known) in enumerate(samples(kind, seed)):
        step.said = vehicle.carried(step.said)
        wanted = wanted_from(step.tell(known), step)
        got = fly(vehicle, step, life)
        life = step.life
        for number in STATES:
            time = got[number].pop(1, None)
            assert (time is not None) == bool(got[number])
            assert_near(number, got[number], wanted[number], f"PONTE_SEED={seed}, {kind} sources, sample {index}")


@pytest.mark.parametrize("kind", SOURCES)
@DIALECTS
@pytest.mark.parametrize("carrier_type", [Udp, Tcp, SerialLine])
def test_every_field_is_told_or_absent(
    start_vsm: StartVsm, carrier_type: type, dialect: ModuleType, kind: str
) -> None:
    receiver = DliReceiver()
    carrier = carrier_type()
    start_vsm(carrier.endpoint, f"udpout://127.0.0.1:{receiver.port}")
    judge(Vehicle(carrier, dialect, receiver), kind)


@pytest.mark.parametrize("kind", SOURCES)
def test_stations_of_a_group_learn_every_field(start_vsm: StartVsm, kind: str) -> None:
    try:
        receiver = DliReceiver(GROUP)
    except OSError as error:
        pytest.skip(f"this machine has no multicast on its loopback: {error}")
    carrier = Udp()
    start_vsm(carrier.endpoint, f"udpmulticast://{GROUP}:{receiver.port}?interface=lo")
    judge(Vehicle(carrier, dialect_v2, receiver), kind)


def fields_told(vehicle: Vehicle, number: int) -> set[int]:
    return {field for message in vehicle.answers() if message.number == number for field in message.fields}


@pytest.mark.parametrize("unknown", range(3), ids=["roll", "pitch", "yaw"])
def test_accelerations_are_absent_without_an_attitude(start_vsm: StartVsm, unknown: int) -> None:
    """Without all three angles nobody knows where north, east and down are, also when they were known before."""
    vehicle = meet(start_vsm, dialect_v2)
    accelerations = {9, 10, 11}

    def told_with(*angles: float) -> set[int]:
        vehicle.say("attitude", 0, *angles, 0.0, 0.0, 0.0)
        vehicle.say("scaled_imu", 0, 10, 20, -990, 1, 2, 3, 0, 0, 0)
        vehicle.say("attitude", 0, *angles, 0.0, 0.0, 0.0)
        return fields_told(vehicle, telemetry_maths.INERTIAL) & accelerations

    partly = [math.nan if index == unknown else 0.1 for index in range(3)]
    assert told_with(*partly) == set(), "before any attitude"
    assert told_with(0.1, 0.1, 0.1) == accelerations
    assert told_with(*partly) == set(), "after a known attitude"


@pytest.mark.parametrize("pressure, temperature", [(math.nan, 1500), (900.0, -30_000)], ids=["pressure", "temperature"])
def test_true_airspeed_is_absent_without_air_data(
    start_vsm: StartVsm, pressure: float, temperature: int
) -> None:
    """Without pressure and temperature nobody knows how dense the air is, also when they were known before."""
    vehicle = meet(start_vsm, dialect_v2)

    def told_with(hectopascals: float, hundredths: int) -> set[int]:
        vehicle.say("scaled_pressure", 0, hectopascals, 0.0, hundredths)
        vehicle.say("vfr_hud", 20.0, 20.0, 0, 50, 100.0, 0.0)
        return fields_told(vehicle, telemetry_maths.AIR) & {4, 5}

    assert told_with(pressure, temperature) == {5}, "before any air data"
    assert told_with(900.0, 1500) == {4, 5}
    assert told_with(pressure, temperature) == {5}, "after known air data"
