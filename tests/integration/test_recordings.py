"""Real recordings through `ponte inspect` and `ponte translate`, against counts and values found with pymavlink."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest
from pymavlink.dialects.v20 import all as dialect

import mavlink_frames
import tlog
from inertial_judge import expected_of, judge
from programs import json_objects
from recordings_found import parameters

Key = tuple[int, int, int]


def counted(path: Path) -> Counter[Key]:
    """How many whole frames there are by system, component and message.

    A frame of a message that nobody here knows counts, since its checksum cannot be judged; a wrong one does not.
    """
    counts: Counter[Key] = Counter()
    for record in tlog.read_records(path):
        frame = mavlink_frames.parse(record.frame)
        if mavlink_frames.checksum_is_right(frame) is not False:
            counts[frame.system, frame.component, frame.message_id] += 1
    return counts


@pytest.mark.parametrize("recording", parameters())
def test_inspect_counts_what_is_in_the_recording(ponte: Path, recording: Path) -> None:
    counts: Counter[Key] = Counter()
    names: dict[int, str] = {}
    for line in json_objects([ponte, "inspect", recording, "--json"]):
        if line["kind"] == "message":
            counts[line["system"], line["component"], line["id"]] += line["count"]
            names[line["id"]] = line["name"]
    expected = counted(recording)
    both = {key: (counts[key], expected[key]) for key in counts.keys() | expected.keys()}
    differing = {key: pair for key, pair in both.items() if pair[0] != pair[1]}
    assert not differing, f"(system, component, id): (ponte, pymavlink) {differing}"
    assert {i: dialect.mavlink_map[i].msgname for i in names if i in dialect.mavlink_map} == {
        i: name for i, name in names.items() if i in dialect.mavlink_map
    }


@pytest.mark.parametrize("recording", parameters())
def test_every_attitude_becomes_inertial_states(ponte: Path, recording: Path) -> None:
    judged = judge(expected_of(recording), json_objects([ponte, "translate", recording, "--json"]))
    assert not judged.findings, judged.report()
