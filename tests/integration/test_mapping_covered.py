"""Every row of the mapping document is exercised by a test beside this one; a new row without a test is noticed here.

The document is the one that the build writes from the rows of the program: PONTE_TOOLS/../docs/mapping.md.
"""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest

import flight_status
import test_vsm_fields
import test_vsm_legs
from telemetry_maths import Told
from telemetry_samples import SOURCES

# Judged one by one in test_vsm_reports.py and test_vsm_legs.py, each with all fields of the message.
REPORTED_FIELDS = {
    3: {2, 3, 4, 5, 6, 7, 8, 9},
    3001: {2},
    3002: {17},
    4001: {2, 7, 13, *test_vsm_legs.FROM, *test_vsm_legs.TO, *test_vsm_legs.NEXT},
    16000: {3, 4, 5, 10, 11, 12, 13},
    16001: {2, 3, 4},
}
REPORTED_FACTS = {("NAV_CONTROLLER_OUTPUT", "arrival")}
# The samples always know these, so that a test has something to wait for.
ALWAYS_KNOWN = {
    ("HIGHRES_IMU", "body_yaw_rate"),
    ("SCALED_IMU", "body_yaw_rate"),
}
MODES = {"ArduCopter": flight_status.COPTER, "ArduPlane": flight_status.PLANE, "PX4": flight_status.PX4_MODES}

Rows = dict[str, list[list[str]]]


@pytest.fixture(scope="module")
def document() -> Rows:
    """The cells of all tables by their heading."""
    tools = os.environ.get("PONTE_TOOLS")
    path = Path(tools or "") / ".." / "docs" / "mapping.md"
    if tools is None or not path.is_file():
        pytest.skip(f"there is no mapping document {path}")
    rows: Rows = {}
    heading = ""
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            heading = line.lstrip("#").strip() if not line.startswith("### #") else line.removeprefix("### ")
        elif line.startswith("|") and not line.startswith("|---"):
            rows.setdefault(heading, []).append([cell.strip() for cell in line.strip("|").split("|")])
    return {heading: table[1:] for heading, table in rows.items()}


@pytest.fixture(scope="module")
def tells() -> list[Told]:
    """What the samples of all vehicles must make the VSM tell."""
    return [
        one
        for kind in SOURCES
        for step, known in test_vsm_fields.samples(kind, test_vsm_fields.DEFAULT_SEED)
        for one in step.tell(known)
    ]


def test_every_source_is_sent_known_and_unknown(document: Rows, tells: list[Told]) -> None:
    rows = {(name, row[0]) for name, table in document.items() if name.isupper() and name not in MODES for row in table}
    known = {(one.source, one.fact) for one in tells if one.raw is not None}
    unknown = {(one.source, one.fact) for one in tells if one.raw is None}
    assert rows == known | REPORTED_FACTS
    assert rows - REPORTED_FACTS - unknown == ALWAYS_KNOWN


def test_every_field_is_judged(document: Rows, tells: list[Told]) -> None:
    rows = {
        (int(found[1]), int(row[0].split()[0]))
        for name, table in document.items()
        if (found := re.match(r"#(\d+) ", name))
        for row in table
    }
    judged = {(one.number, one.field) for one in tells if one.raw is not None}
    judged |= {(number, field) for number, fields in REPORTED_FIELDS.items() for field in fields}
    assert rows == judged


@pytest.mark.parametrize("stack, modes", MODES.items())
def test_every_mode_is_sent(document: Rows, stack: str, modes: dict[str, tuple[int, int | None]]) -> None:
    rows = {row[1]: int(row[0].split()[0]) for row in document[stack]}
    assert rows == {name: custom_mode for name, (custom_mode, _) in modes.items()}


def test_every_sensor_bit_fails_once(document: Rows) -> None:
    assert {int(row[0]) for row in document["Subsystems"]} == flight_status.SUBSYSTEM_OF_BIT.keys()


def test_every_word_is_said(document: Rows) -> None:
    words = {row[0] for row in document["Words in STATUSTEXT"]}
    assert words <= set(re.findall("[a-z0-9]+", " ".join(flight_status.TEXTS).lower()))
