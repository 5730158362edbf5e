"""Seeded random attitudes through `ponte translate`, against the independent calculation."""

from __future__ import annotations

import math
import random
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pymavlink.dialects.v20 import common as dialect

import flight_maths
import tlog
from inertial_judge import Expected, expected_of, judge
from programs import json_objects, seed_or

COUNT = 2000
DEFAULT_SEED = 30
START_US = 1_700_000_000_000_000
STEP_MS = 20

Attitude = tuple[float, float, float, float, float, float]


def random_attitude(source: random.Random) -> Attitude:
    """Any roll and yaw, exactly half a turn to either side among them; pitch well away from the vertical."""

    def turn() -> float:
        return source.choice((math.pi, -math.pi)) if source.random() < 0.05 else source.uniform(-math.pi, math.pi)

    pitch = math.radians(source.uniform(-80.0, 80.0))
    return turn(), pitch, turn(), source.uniform(-10, 10), source.uniform(-10, 10), source.uniform(-10, 10)


def frames(attitudes: list[Attitude]) -> Iterator[tuple[int, bytes]]:
    """The attitudes as an autopilot sends them, with a heartbeat each second."""
    link = dialect.MAVLink(None, srcSystem=1, srcComponent=1)
    for index, attitude in enumerate(attitudes):
        boot_ms = index * STEP_MS
        messages: list[Any] = [dialect.MAVLink_attitude_message(boot_ms, *attitude)]
        if boot_ms % 1000 == 0:
            messages.insert(0, dialect.MAVLink_heartbeat_message(2, 3, 81, 0, 3, 3))
        for message in messages:
            yield START_US + boot_ms * 1000, bytes(message.pack(link))
            link.seq = (link.seq + 1) % 256


def translated(ponte: Path, path: Path, attitudes: list[Attitude]) -> tuple[Expected, list[dict[str, Any]]]:
    """Writes a recording with these attitudes and translates it."""
    tlog.write_log(path, frames(attitudes))
    return expected_of(path), list(json_objects([ponte, "translate", path, "--json"]))


def test_random_attitudes(ponte: Path, tmp_path: Path) -> None:
    seed = seed_or(DEFAULT_SEED)
    source = random.Random(seed)
    attitudes = [random_attitude(source) for _ in range(COUNT)]
    expected, messages = translated(ponte, tmp_path / "random.tlog", attitudes)
    assert len(expected.attitudes) == COUNT
    assert all(set(range(12, 18)) <= a.fields.keys() for a in expected.attitudes)
    judged = judge(expected, messages)
    assert not judged.findings, f"PONTE_SEED={seed}\n{judged.report()}"


def test_rates_are_absent_when_the_nose_is_vertical(ponte: Path, tmp_path: Path) -> None:
    vertical: list[Attitude] = [(0.1, pitch, 0.2, 0.3, 0.4, 0.5) for pitch in (math.pi / 2, -math.pi / 2)]
    level: list[Attitude] = [(0.1, 0.0, 0.2, 0.3, 0.4, 0.5)]
    expected, messages = translated(ponte, tmp_path / "vertical.tlog", vertical + level)
    assert [sorted(a.fields) for a in expected.attitudes] == [[12, 13, 14], [12, 13, 14], [12, 13, 14, 15, 16, 17]]
    judged = judge(expected, messages)
    assert not judged.findings, judged.report()


def test_rates_beyond_the_range_of_the_field_are_absent(ponte: Path, tmp_path: Path) -> None:
    largest = 32767 * flight_maths.RATE_UNIT
    attitudes: list[Attitude] = [(0.0, 0.0, 0.0, rate, 0.0, 0.0) for rate in (largest - 1, -largest + 1, 200.0, -200.0)]
    expected, messages = translated(ponte, tmp_path / "fast.tlog", attitudes)
    assert [15 in a.fields for a in expected.attitudes] == [True, True, False, False]
    judged = judge(expected, messages)
    assert not judged.findings, judged.report()


def test_a_value_that_is_not_a_number_is_absent(ponte: Path, tmp_path: Path) -> None:
    nan = math.nan
    attitudes: list[Attitude] = [
        (0.1, 0.2, nan, 0.3, 0.4, 0.5),
        (0.1, nan, 0.2, 0.3, 0.4, 0.5),
        (0.1, 0.2, 0.3, nan, 0.4, 0.5),
    ]
    expected, messages = translated(ponte, tmp_path / "nan.tlog", attitudes)
    assert [sorted(a.fields) for a in expected.attitudes] == [[12, 13, 15, 16, 17], [12, 14], [12, 13, 14, 16, 17]]
    judged = judge(expected, messages)
    assert not judged.findings, judged.report()
