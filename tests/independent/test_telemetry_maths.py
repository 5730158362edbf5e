"""The judge's telemetry against figures of the mapping facts and against what physics says by itself."""

from __future__ import annotations

import math

import pytest

import flight_status
from telemetry_maths import AIR, BODY, INERTIAL, OPERATING, RULES, Known, earth_acceleration, raw_of


@pytest.mark.parametrize(
    "number, field, value, raw",
    [
        (INERTIAL, 4, 120.5, 0x1789), (INERTIAL, 6, 12.3, 0xF6), (INERTIAL, 15, 0.1, 20), (BODY, 5, 0.1, 1000),
        (AIR, 6, 293.15, 586), (OPERATING, 12, 50, 31250), (INERTIAL, 13, math.radians(-5), 0xFC72 - 0x10000),
    ],
)  # fmt: skip
def test_figures_of_the_facts(number: int, field: int, value: float, raw: int) -> None:
    assert raw_of(number, field, value) == raw


def test_what_does_not_fit_is_unknown() -> None:
    assert raw_of(BODY, 5, 3.2767) == 32767
    assert raw_of(BODY, 5, 3.3) is None
    assert raw_of(AIR, 5, -1.0) is None
    assert raw_of(AIR, 5, math.nan) is None


@pytest.mark.parametrize("yaw", [0.0, 1.0, -3.0])
def test_standing_still_is_no_acceleration_in_any_attitude(yaw: float) -> None:
    """On a slope the accelerometers feel the ground push against gravity along the Earth's vertical."""
    roll, pitch, g = 0.3, -0.7, 9.80665
    felt = g * math.sin(pitch), -g * math.sin(roll) * math.cos(pitch), -g * math.cos(roll) * math.cos(pitch)
    assert earth_acceleration(felt, (roll, pitch, yaw)) == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def test_an_acceleration_ahead_points_where_the_nose_points() -> None:
    assert earth_acceleration((2.0, 0.0, -9.80665), (0.0, 0.0, math.pi / 2)) == pytest.approx((0.0, 2.0, 0.0), abs=1e-9)


def test_wind_from_the_north_blows_to_the_south() -> None:
    fields = {one.field: one.raw for one in RULES["wind"]({"direction": 0.0, "speed": 10.0}, Known())}
    assert fields == {7: -200, 8: 0}


def test_the_pressure_at_sea_level_is_at_altitude_zero() -> None:
    sample = {"press_abs": 1013.25, "temperature": 1500}
    assert {one.field: one.raw for one in RULES["scaled_pressure"](sample, Known())} == {12: 0, 6: 576}


def test_the_worst_sensor_is_the_state_of_its_subsystem() -> None:
    everything = 0xFFFFFFFF
    states = flight_status.subsystem_states(everything, everything, everything & ~(1 << 5 | 1 << 17), armed=True)
    assert states[flight_status.NAVIGATION] == flight_status.WARNING
    second_gyro = flight_status.subsystem_states(everything, everything, everything & ~(1 << 17), armed=True)
    assert second_gyro[flight_status.NAVIGATION] == flight_status.CAUTION
    assert flight_status.VSM not in states
