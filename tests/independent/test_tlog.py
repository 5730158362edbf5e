"""Recordings survive writing and reading, and damage is named with its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from tlog import DamagedLog, packed, read_records, write_log

V1 = bytes.fromhex("fe0900010100000000000203510403") + b"\x00\x00"
V2 = bytes.fromhex("fd0900002a0101000000 040000000203510403 8fa1")
SIGNED = bytes.fromhex("fd0101002a0101000000 04 8fa1") + bytes(13)
RECORDS = [(1, V1), (2**60, V2), (3, SIGNED)]


@pytest.mark.parametrize("name", ["a.tlog", "a.tlog.gz"])
def test_written_records_are_read_again(tmp_path: Path, name: str) -> None:
    write_log(tmp_path / name, RECORDS)
    assert [(r.time_us, r.frame) for r in read_records(tmp_path / name)] == RECORDS
    assert [r.offset for r in read_records(tmp_path / name)] == [0, 8 + len(V1), 16 + len(V1) + len(V2)]


def test_a_compressed_file_is_the_same_every_time(tmp_path: Path) -> None:
    for name in ("a.tlog.gz", "b.tlog.gz"):
        write_log(tmp_path / name, RECORDS)
    assert (tmp_path / "a.tlog.gz").read_bytes() == (tmp_path / "b.tlog.gz").read_bytes()


def test_every_cut_inside_a_record_is_named(tmp_path: Path) -> None:
    content = packed(RECORDS[:2])
    first = 8 + len(V1)
    for size in set(range(1, len(content))) - {first}:
        (tmp_path / "a.tlog").write_bytes(content[:size])
        with pytest.raises(DamagedLog, match=f"record at {first if size > first else 0}$"):
            list(read_records(tmp_path / "a.tlog"))


def test_garbage_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.tlog").write_bytes(bytes(8) + b"\x89PNG")
    with pytest.raises(DamagedLog, match="89"):
        list(read_records(tmp_path / "a.tlog"))
