"""The damaged recordings are damaged where they say, and sound before that."""

from __future__ import annotations

import zlib
from collections.abc import Callable
from pathlib import Path

import pytest

import tlog
from damaged_logs import DAMAGES, NO_RECORDINGS, Damaged
from recordings_found import OWN_FOLDER

RECORDING = OWN_FOLDER / "ap_mission_v2_trimmed.tlog.gz"


def before(records: list[tlog.Record], usable: int) -> list[tlog.Record]:
    """The records that lie wholly in the first bytes."""
    return [record for record in records if record.offset + tlog.TIME_SIZE + len(record.frame) <= usable]


@pytest.mark.parametrize("damage", DAMAGES)
def test_the_sound_part_is_the_beginning_of_the_whole(tmp_path: Path, damage: Callable[[Path], Damaged]) -> None:
    damaged = damage(RECORDING)
    path = tmp_path / damaged.name
    path.write_bytes(damaged.content)
    whole = list(tlog.read_records(RECORDING))
    sound: list[tlog.Record] = []
    with pytest.raises((tlog.DamagedLog, OSError, EOFError, zlib.error)):
        for record in tlog.read_records(path):
            sound.append(record)
    assert 500 < len(before(whole, damaged.usable)) <= len(whole)
    # Python gives up on a damaged gzip file a buffer earlier, so what it read may be less, but not other.
    sound_before = before(sound, damaged.usable)
    assert sound_before == whole[: len(sound_before)]


@pytest.mark.parametrize("name", sorted(NO_RECORDINGS))
def test_no_recording_holds_a_record(tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    path.write_bytes(NO_RECORDINGS[name])
    records: list[tlog.Record] = []
    try:
        records.extend(tlog.read_records(path))
    except (tlog.DamagedLog, OSError, EOFError, zlib.error):
        pass
    assert records == []
