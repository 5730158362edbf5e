"""The small recordings hold whole frames, and a whole flight each."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

import mavlink_frames
import tlog

FOLDER = Path(__file__).resolve().parents[1] / "recordings"
RECORDINGS = sorted(FOLDER.glob("*_trimmed.tlog.gz"))
FLIGHTS = [path for path in RECORDINGS if "_mission_" in path.name]
SIZE_LIMIT = 300_000
ARMED_FLAG = 128


def test_there_are_three_flights_and_a_signed_link_and_they_are_small() -> None:
    assert [path.name.split("_mission")[0] for path in FLIGHTS] == ["ap", "ap", "px4"]
    assert {path.name for path in RECORDINGS} - {path.name for path in FLIGHTS} == {"ap_signing_v2_trimmed.tlog.gz"}
    assert sum(path.stat().st_size for path in RECORDINGS) < SIZE_LIMIT


def frames(path: Path) -> list[mavlink_frames.Frame]:
    return [mavlink_frames.parse(record.frame) for record in tlog.read_records(path)]


@pytest.mark.parametrize("path", RECORDINGS, ids=lambda path: path.name)
def test_every_checksum_is_right(path: Path) -> None:
    assert {mavlink_frames.checksum_is_right(frame) for frame in frames(path)} == {True}


@pytest.mark.parametrize("path", RECORDINGS, ids=lambda path: path.name)
def test_time_never_goes_back(path: Path) -> None:
    times = [record.time_us for record in tlog.read_records(path)]
    assert all(earlier <= later for earlier, later in pairwise(times))


def messages_of(path: Path, system: int, *names: str) -> list[Any]:
    decodable = (f for f in frames(path) if f.system == system and f.message_id in mavlink_frames.dialect.mavlink_map)
    decoded = (mavlink_frames.decode(frame) for frame in decodable)
    return [message for message in decoded if message.get_type() in names]


@pytest.mark.parametrize("path", FLIGHTS, ids=lambda path: path.name)
def test_the_flight_has_its_whole_life_cycle(path: Path) -> None:
    armed = [bool(m.base_mode & ARMED_FLAG) for m in messages_of(path, 1, "HEARTBEAT")]
    assert [a for i, a in enumerate(armed) if i == 0 or a != armed[i - 1]] == [False, True, False]
    assert {m.result for m in messages_of(path, 1, "COMMAND_ACK")} > {0}, "a refusal and an acceptance"
    assert messages_of(path, 255, "MISSION_COUNT") and messages_of(path, 1, "MISSION_ACK")
    assert messages_of(path, 255, "MISSION_CLEAR_ALL")
    heights = [m.relative_alt / 1000 for m in messages_of(path, 1, "GLOBAL_POSITION_INT")]
    assert max(heights) > 20
    assert abs(heights[-1]) < 2
    assert len(messages_of(path, 1, "ATTITUDE")) > 100
    assert len(messages_of(path, 1, "VFR_HUD")) > 100
    assert messages_of(path, 1, "STATUSTEXT")
