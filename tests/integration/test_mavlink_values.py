"""The samples reach every edge, and the comparison notices every difference."""

from __future__ import annotations

import math
import random

import pytest
from pymavlink.dialects.v20 import ardupilotmega as dialect

from mavlink_values import FLOAT_MAX, differences, is_zero, samples, slots, to_json

ATTITUDE = dialect.MAVLink_attitude_message
STATUSTEXT = dialect.MAVLink_statustext_message
PARAM_MAP_RC = dialect.MAVLink_param_map_rc_message


def test_slots_find_the_size_of_a_text_that_the_wire_moves() -> None:
    text = next(slot for slot in slots(PARAM_MAP_RC) if slot.name == "param_id")
    assert (text.kind, text.count, text.wire_position) == ("char", 16, 7)


def test_samples_reach_every_edge() -> None:
    drawn = list(samples(ATTITUDE, random.Random(1), 20))
    rolls = [sample["roll"] for sample in drawn]
    times = [sample["time_boot_ms"] for sample in drawn]
    assert {0, 2**32 - 1} <= set(times)
    assert {math.inf, -math.inf, FLOAT_MAX, -FLOAT_MAX, 0.0} <= set(rolls)
    assert any(math.isnan(roll) for roll in rolls)
    texts = {len(sample["text"]) for sample in samples(STATUSTEXT, random.Random(1), 20)}
    assert {0, 50} <= texts


def test_the_same_seed_draws_the_same_samples() -> None:
    one, other = ([to_json(ATTITUDE, s) for s in samples(ATTITUDE, random.Random(5), 20)] for _ in range(2))
    assert one == other


def test_an_exact_answer_has_no_differences() -> None:
    for message_class in (ATTITUDE, STATUSTEXT, PARAM_MAP_RC, dialect.MAVLink_esc_telemetry_1_to_4_message):
        for sample in samples(message_class, random.Random(2), 20):
            assert differences(message_class, sample, to_json(message_class, sample)) == []


ZERO = {name: 0 for name in ATTITUDE.fieldnames} | {"roll": -0.0}


@pytest.mark.parametrize("change", [{"roll": 0.0}, {"pitch": 1e-45}, {"yaw": "NaN"}, {"yaw": "0"}, {"time_boot_ms": 0.0},
                                    {"time_boot_ms": False}, {"yaw": [0]}, {"roll": None}, {"extra": 1},
                                    {"time_boot_ms": "0"}])  # fmt: skip
def test_every_difference_is_found(change: dict) -> None:
    answer = to_json(ATTITUDE, ZERO) | change
    assert differences(ATTITUDE, ZERO, to_json(ATTITUDE, ZERO)) == []
    assert len(differences(ATTITUDE, ZERO, answer)) == 1


@pytest.mark.parametrize("value, zero", [(0, True), ("0", True), ([0, 0.0], True), ("", True), (1, False), ("NaN", False),
                                         ([0, 1], False)])  # fmt: skip
def test_zero(value: object, zero: bool) -> None:
    assert is_zero(value) is zero
