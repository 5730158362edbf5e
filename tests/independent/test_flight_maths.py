"""The independent calculation of #4000 against constants of the documents and against numerical differentiation."""

from __future__ import annotations

import math
import random
import struct
from fractions import Fraction

import pytest

from flight_maths import (
    RATES_ABSENT_FROM,
    angle_difference,
    attitude_fields,
    bam2,
    bam4_from_deg_e7,
    euler_rates,
    position_fields,
    round_half_away,
    scaled,
    wrap_signed,
)

Matrix = list[list[float]]


def float32(value: float) -> float:
    return struct.unpack("<f", struct.pack("<f", value))[0]


@pytest.mark.parametrize("deg_e7, raw", [(387223000, 461975034), (-91393000, -109036096), (1800000000, -(2**31)),
                                         (-1800000000, -(2**31)), (900000000, 2**30), (-900000000, -(2**30)),
                                         (0, 0), (1, 1), (-1, -1)])  # fmt: skip
def test_latitude_and_longitude(deg_e7: int, raw: int) -> None:
    assert bam4_from_deg_e7(deg_e7) == raw


@pytest.mark.parametrize("degrees, word", [(10, 0x071C), (-5, 0xFC72), (180, 0x8000), (-180, 0x8000), (90, 0x4000),
                                           (-2.5, 0xFE39), (0, 0), (359.999, 0)])  # fmt: skip
def test_angles(degrees: float, word: int) -> None:
    assert bam2(math.radians(degrees)) & 0xFFFF == word


@pytest.mark.parametrize("angle", [float32(math.pi), float32(-math.pi)])
def test_half_a_turn_as_a_float_wraps(angle: float) -> None:
    assert bam2(angle) == -32768


def test_worked_example_of_4000() -> None:
    fields = position_fields(387223000, -91393000, 120500, 1230, -450, -100)
    assert fields == {2: 461975034, 3: -109036096, 4: 6025, 5: 3, 6: 246, 7: -90, 8: -20}


@pytest.mark.parametrize("value, rounded", [(2.5, 3), (-2.5, -3), (2.4999, 2), (-2.4999, -2), (0.0, 0),
                                            (Fraction(-1, 2), -1)])  # fmt: skip
def test_rounding(value: float | Fraction, rounded: int) -> None:
    assert round_half_away(value) == rounded


@pytest.mark.parametrize("raw, wrapped", [(32768, -32768), (-32769, 32767), (65536, 0), (-1, -1)])
def test_wrapping(raw: int, wrapped: int) -> None:
    assert wrap_signed(raw, 2) == wrapped


def test_values_that_do_not_fit_are_absent() -> None:
    assert scaled(32767 * 0.005, 0.005, 2) == 32767
    assert scaled(32768 * 0.005, 0.005, 2) is None
    assert scaled(-32768 * 0.005, 0.005, 2) == -32768
    assert scaled(math.nan, 0.005, 2) is None
    assert scaled(math.inf, 0.005, 2) is None
    assert 4 not in position_fields(0, 0, 2**31 - 1, 0, 0, 0)


def test_level_flight_leaves_the_rates_as_they_are() -> None:
    assert euler_rates(0.0, 0.0, (0.1, -0.05, 0.02)) == pytest.approx((0.1, -0.05, 0.02))
    fields = attitude_fields(0.0, 0.0, math.pi / 2, 0.1, -0.05, 0.02)
    assert fields == {12: 0, 13: 0, 14: 16384, 15: 20, 16: -10, 17: 4}


def test_knife_edge_swaps_pitch_and_turn() -> None:
    assert euler_rates(math.pi / 2, 0.0, (0.0, 0.3, 0.2)) == pytest.approx((0.0, -0.2, 0.3))


@pytest.mark.parametrize("pitch", [math.pi / 2, -math.pi / 2, float32(math.pi / 2), RATES_ABSENT_FROM])
def test_rates_are_absent_when_the_nose_is_vertical(pitch: float) -> None:
    assert euler_rates(0.3, pitch, (0.1, 0.1, 0.1)) is None
    assert set(attitude_fields(0.3, pitch, 0.0, 0.1, 0.1, 0.1)) == {12, 13, 14}


def test_a_value_that_is_not_a_number_takes_only_its_own_fields_away() -> None:
    assert set(attitude_fields(math.nan, 0.1, 0.2, 0.1, 0.1, 0.1)) == {13, 14}
    assert set(attitude_fields(0.1, 0.1, math.nan, 0.1, 0.1, 0.1)) == {12, 13, 15, 16, 17}
    assert set(attitude_fields(0.1, 0.1, 0.1, math.nan, 0.1, 0.1)) == {12, 13, 14, 16, 17}


def product(one: Matrix, other: Matrix) -> Matrix:
    return [[sum(one[i][k] * other[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def body_to_earth(roll: float, pitch: float, yaw: float) -> Matrix:
    """The rotation matrix for yaw, then pitch, then roll."""
    cr, sr, cp, sp = math.cos(roll), math.sin(roll), math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    about_z = [[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]]
    about_y = [[cp, 0.0, sp], [0.0, 1.0, 0.0], [-sp, 0.0, cp]]
    about_x = [[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]]
    return product(product(about_z, about_y), about_x)


def angles(matrix: Matrix) -> tuple[float, float, float]:
    roll = math.atan2(matrix[2][1], matrix[2][2])
    return roll, math.asin(-matrix[2][0]), math.atan2(matrix[1][0], matrix[0][0])


def turned_by_body_rates(matrix: Matrix, rates: tuple[float, float, float], step: float) -> Matrix:
    """The matrix after `step` seconds: R * exp([w]x * step), the series to the second order."""
    p, q, r = (rate * step for rate in rates)
    cross = [[0.0, -r, q], [r, 0.0, -p], [-q, p, 0.0]]
    square = product(cross, cross)
    turn = [[float(i == j) + cross[i][j] + square[i][j] / 2 for j in range(3)] for i in range(3)]
    return product(matrix, turn)


def test_rates_agree_with_a_small_turn_of_the_rotation_matrix() -> None:
    """Another way to the same numbers: turn the matrix a little by the body rates and look how the angles change."""
    source, step = random.Random(4586), 1e-5
    for _ in range(500):
        roll, yaw = source.uniform(-3, 3), source.uniform(-3, 3)
        pitch = source.uniform(-1.3, 1.3)
        rates = (source.uniform(-5, 5), source.uniform(-5, 5), source.uniform(-5, 5))
        matrix = body_to_earth(roll, pitch, yaw)
        before = angles(turned_by_body_rates(matrix, rates, -step))
        after = angles(turned_by_body_rates(matrix, rates, step))
        slope = [math.remainder(b - a, 2 * math.pi) / (2 * step) for a, b in zip(before, after)]
        assert euler_rates(roll, pitch, rates) == pytest.approx(slope, rel=1e-4, abs=1e-4)


def test_differences_of_angles_go_the_short_way() -> None:
    assert angle_difference(-32768, 32767, 2) == 1
    assert angle_difference(5, -5, 2) == 10
