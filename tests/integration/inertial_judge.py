"""Judges a sequence of translated #4000 Inertial States against the recording they come from."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import flight_maths
import mavlink_frames
import tlog
from dli_tables import tables

ATTITUDE, GLOBAL_POSITION_INT = 30, 33
AUTOPILOT_SYSTEM = 1
FINDINGS_KEPT = 20

NAMES = {
    2: "latitude", 3: "longitude", 4: "altitude", 5: "altitude_type", 6: "u_speed", 7: "v_speed", 8: "w_speed",
    12: "roll", 13: "pitch", 14: "heading", 15: "roll_rate", 16: "pitch_rate", 17: "turn_rate",
}  # fmt: skip
ANGLE_SIZES = {2: 4, 3: 4, 12: 2, 13: 2, 14: 2}
RATES = {15, 16, 17}
ALTITUDE_TYPES = {flight_maths.ALTITUDE_TYPE_BARO, flight_maths.ALTITUDE_TYPE_WGS84}
FIELDS = tables("3")[4000].fields


class Attitude(NamedTuple):
    """What one ATTITUDE must become, and how many positions came before it."""

    fields: dict[int, int]
    rates_may_be_absent: bool
    positions_before: int


@dataclass
class Expected:
    """What a recording demands, in its order."""

    attitudes: list[Attitude] = field(default_factory=list)
    positions: list[dict[int, int]] = field(default_factory=list)


def add_attitude(expected: Expected, message: Any) -> None:
    fields = flight_maths.attitude_fields(
        message.roll, message.pitch, message.yaw, message.rollspeed, message.pitchspeed, message.yawspeed
    )
    unsure = flight_maths.RATES_SURE_BELOW < abs(message.pitch) < flight_maths.RATES_ABSENT_FROM
    expected.attitudes.append(Attitude(fields, unsure, len(expected.positions)))


def add_position(expected: Expected, m: Any) -> None:
    expected.positions.append(flight_maths.position_fields(m.lat, m.lon, m.alt, m.vx, m.vy, m.vz))


def add_frame(expected: Expected, frame: mavlink_frames.Frame) -> None:
    """Takes one frame of a recording into account, if it is one of the two messages and comes from the autopilot."""
    if frame.system != AUTOPILOT_SYSTEM:
        return
    if frame.message_id == ATTITUDE:
        add_attitude(expected, mavlink_frames.decode(frame))
    elif frame.message_id == GLOBAL_POSITION_INT:
        add_position(expected, mavlink_frames.decode(frame))


def expected_of(path: Path) -> Expected:
    """Reads a recording once."""
    expected = Expected()
    for record in tlog.read_records(path):
        add_frame(expected, mavlink_frames.parse(record.frame))
    return expected


class InertialJudge:
    """Takes the translated objects one by one, in order, and keeps what is wrong with them."""

    def __init__(self, expected: Expected) -> None:
        self.expected = expected
        self.findings: list[str] = []
        self.attitudes_seen = 0
        self.positions_seen = 0

    def take(self, translated: dict[str, Any]) -> None:
        fields = translated["fields"]
        raws = {number: fields[name]["raw"] for number, name in NAMES.items() if name in fields}
        self._check_values(fields)
        window = self._positions_before_next_attitude()
        if "roll" in fields:
            window = self._check_attitude(raws)
        if "latitude" in fields or "longitude" in fields:
            self.positions_seen += 1
            self._check_position(raws, window)

    def finish(self) -> None:
        """Says what is missing in the end."""
        wanted = len(self.expected.attitudes)
        if self.attitudes_seen != wanted:
            self._note(f"{wanted} ATTITUDE became {self.attitudes_seen} #4000 with roll")
        before_an_attitude = self.expected.positions[: self.expected.attitudes[-1].positions_before] if wanted else []
        if not self.positions_seen and any(position[2] or position[3] for position in before_an_attitude):
            self._note("no #4000 has a position, though the recording has them")

    def report(self) -> str:
        """The findings, one a line; after the first ones no more are kept."""
        return "\n".join(self.findings)

    def _positions_before_next_attitude(self) -> list[dict[int, int]]:
        """The positions that may be the newest one at this point: the last known and those up to the next ATTITUDE."""
        attitudes, positions, seen = self.expected.attitudes, self.expected.positions, self.attitudes_seen
        first = attitudes[seen - 1].positions_before - 1 if seen else 0
        last = attitudes[seen].positions_before if seen < len(attitudes) else len(positions)
        return positions[max(first, 0) : last]

    def _check_attitude(self, raws: dict[int, int]) -> list[dict[int, int]]:
        """Compares with the ATTITUDE whose turn it is, and gives the one position that was the newest then."""
        index, self.attitudes_seen = self.attitudes_seen, self.attitudes_seen + 1
        if index >= len(self.expected.attitudes):
            return []
        wanted = self.expected.attitudes[index]
        for number in range(12, 18):
            if number in RATES and wanted.rates_may_be_absent and number not in raws:
                continue
            self._compare(f"ATTITUDE {index}", number, wanted.fields.get(number), raws.get(number))
        newest = wanted.positions_before
        return self.expected.positions[newest - 1 : newest] if newest else []

    def _check_position(self, raws: dict[int, int], window: list[dict[int, int]]) -> None:
        """At least one of the positions must agree in all fields that are present."""
        where = f"position after ATTITUDE {self.attitudes_seen}"
        if not {2, 3} <= raws.keys():
            self._note(f"{where}: latitude without longitude or the reverse")
        if 5 in raws and raws[5] not in ALTITUDE_TYPES:
            self._note(f"{where}: altitude type {raws[5]}")
        sent = {number: raw for number, raw in raws.items() if number in (2, 3, 4, 6, 7, 8)}
        if not any(all(self._near(n, position.get(n), raw) for n, raw in sent.items()) for position in window):
            self._note(f"{where}: {sent} is none of {window[-3:]}")

    def _check_values(self, fields: dict[str, Any]) -> None:
        """The value beside a raw integer is that integer in the unit of the table, to half a step."""
        for number, name in NAMES.items():
            factor = FIELDS[number].factor
            if name in fields and factor is not None:
                raw, value = fields[name]["raw"], fields[name]["value"]
                if not math.isclose(value, raw * factor, rel_tol=0.0, abs_tol=factor / 2):
                    self._note(f"{name}: raw {raw} with value {value}")
                if fields[name].get("unit") != FIELDS[number].unit:
                    self._note(f"{name}: unit {fields[name].get('unit')!r}")

    def _compare(self, where: str, number: int, wanted: int | None, got: int | None) -> None:
        if (wanted is None) != (got is None) or not self._near(number, wanted, got):
            self._note(f"{where}: {NAMES[number]} is {got}, must be {wanted}")

    @staticmethod
    def _near(number: int, wanted: int | None, got: int | None) -> bool:
        """Whether two raw values are the same within one unit; angles may differ by a full turn."""
        if wanted is None or got is None:
            return wanted is got
        size = ANGLE_SIZES.get(number)
        return (flight_maths.angle_difference(wanted, got, size) if size else abs(wanted - got)) <= 1

    def _note(self, finding: str) -> None:
        if len(self.findings) < FINDINGS_KEPT:
            self.findings.append(finding)


def judge(expected: Expected, translated: Iterable[dict[str, Any]]) -> InertialJudge:
    """Judges all #4000 in what `ponte translate --json` printed."""
    judging = InertialJudge(expected)
    for message in translated:
        if message["number"] == 4000:
            judging.take(message)
    judging.finish()
    return judging
