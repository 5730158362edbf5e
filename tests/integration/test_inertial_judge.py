"""The judge of #4000 finds nothing in a right translation and something in every wrong one."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as dialect

from dli_tables import tables
from inertial_judge import NAMES, Expected, add_attitude, add_position, judge

FIELDS = tables("3")[4000].fields


def attitude(roll: float) -> Any:
    return dialect.MAVLink_attitude_message(0, roll, 0.2, -1.0, 0.1, -0.2, 0.3)


def position(lat: int) -> Any:
    return dialect.MAVLink_global_position_int_message(0, lat, -91393000, 120500, 0, 1230, -450, -100, 0)


@pytest.fixture
def expected() -> Expected:
    """A position, two attitudes, another position, one more attitude."""
    made = Expected()
    add_position(made, position(387223000))
    add_attitude(made, attitude(0.1))
    add_attitude(made, attitude(math.pi))
    add_position(made, position(387224000))
    add_attitude(made, attitude(0.3))
    return made


def as_json(raws: dict[int, int]) -> dict[str, Any]:
    fields = {}
    for number, raw in raws.items():
        factor = FIELDS[number].factor
        fields[NAMES[number]] = {"raw": raw, "unit": FIELDS[number].unit} | ({"value": raw * factor} if factor else {})
    return {"number": 4000, "fields": fields}


def right(expected: Expected) -> list[dict[str, Any]]:
    """What a right program prints: positions with the attitude that follows them."""
    one, two, three = (a.fields for a in expected.attitudes)
    first, second = expected.positions
    return [as_json(one | first), {"number": 3009, "fields": {}}, as_json(two), as_json(second), as_json(three | second)]


def test_a_right_translation_passes(expected: Expected) -> None:
    assert judge(expected, right(expected)).findings == []


def test_one_unit_and_a_full_turn_are_no_difference(expected: Expected) -> None:
    messages = right(expected)
    messages[0]["fields"]["roll"]["raw"] += 1
    messages[0]["fields"]["latitude"]["raw"] -= 1
    messages[2]["fields"]["roll"] = {"raw": 32767, "value": 32767 * math.pi / 32768, "unit": "rad"}
    messages[0]["fields"]["roll"]["value"] += FIELDS[12].factor
    messages[0]["fields"]["latitude"]["value"] -= FIELDS[2].factor
    assert judge(expected, messages).findings == []


def drop_attitude(messages: list[dict[str, Any]]) -> None:
    del messages[2]


def repeat_attitude(messages: list[dict[str, Any]]) -> None:
    messages.append(copy.deepcopy(messages[-1]))


def old_position(messages: list[dict[str, Any]]) -> None:
    for name in ("latitude", "longitude"):
        messages[4]["fields"][name] = messages[0]["fields"][name]


def position_too_early(messages: list[dict[str, Any]]) -> None:
    messages[0]["fields"]["latitude"] = messages[4]["fields"]["latitude"]


def no_positions(messages: list[dict[str, Any]]) -> None:
    for message in messages:
        message["fields"].pop("latitude", None)
        message["fields"].pop("longitude", None)


def no_turn_rate(messages: list[dict[str, Any]]) -> None:
    del messages[0]["fields"]["turn_rate"]


def height_above_ground(messages: list[dict[str, Any]]) -> None:
    messages[0]["fields"]["altitude_type"]["raw"] = 2


def wrong_value(messages: list[dict[str, Any]]) -> None:
    messages[0]["fields"]["roll"]["value"] *= 2


def wrong_unit(messages: list[dict[str, Any]]) -> None:
    messages[0]["fields"]["roll"]["unit"] = "deg"


def two_units_off(messages: list[dict[str, Any]]) -> None:
    for name in ("roll", "pitch", "heading", "roll_rate", "pitch_rate", "turn_rate"):
        messages[0]["fields"][name]["raw"] += 2


def roll_and_heading_swapped(messages: list[dict[str, Any]]) -> None:
    fields = messages[0]["fields"]
    fields["roll"], fields["heading"] = fields["heading"], fields["roll"]


@pytest.mark.parametrize("damage", [drop_attitude, repeat_attitude, old_position, position_too_early, no_positions,
                                    no_turn_rate, height_above_ground, wrong_value, wrong_unit, two_units_off,
                                    roll_and_heading_swapped])  # fmt: skip
def test_every_wrong_translation_is_noticed(expected: Expected, damage: Callable[[list[dict[str, Any]]], None]) -> None:
    messages = right(expected)
    damage(messages)
    assert judge(expected, messages).findings != []
