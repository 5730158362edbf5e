"""Reads and writes .tlog recordings: eight bytes of time, big endian microseconds, then one whole MAVLink frame."""

from __future__ import annotations

import gzip
import struct
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import BinaryIO, NamedTuple

TIME_SIZE = 8
SIGNATURE_SIZE = 13
SIGNED_FLAG = 0x01


class Record(NamedTuple):
    """One frame with the time it was recorded, and where the record begins in the uncompressed file."""

    time_us: int
    frame: bytes
    offset: int


class DamagedLog(ValueError):
    """The bytes at an offset are not a record."""


def open_log(path: Path) -> BinaryIO:
    """Opens a recording, compressed or not."""
    return gzip.open(path, "rb") if path.suffix == ".gz" else path.open("rb")  # type: ignore[return-value]


def frame_size(head: bytes) -> int:
    """The size of the frame whose first three bytes are given."""
    if head[0] == 0xFE:
        return 8 + head[1]
    if head[0] == 0xFD:
        return 12 + head[1] + (SIGNATURE_SIZE if head[2] & SIGNED_FLAG else 0)
    raise DamagedLog(f"no frame starts with {head[0]:02x}")


def read_records(path: Path) -> Iterator[Record]:
    """All records in order, one at a time."""
    offset = 0
    with open_log(path) as log:
        while head := log.read(TIME_SIZE + 3):
            if len(head) < TIME_SIZE + 3:
                raise DamagedLog(f"{path}: ends inside the record at {offset}")
            size = frame_size(head[TIME_SIZE:])
            rest = log.read(size - 3)
            if len(rest) < size - 3:
                raise DamagedLog(f"{path}: ends inside the record at {offset}")
            yield Record(int.from_bytes(head[:TIME_SIZE], "big"), head[TIME_SIZE:] + rest, offset)
            offset += TIME_SIZE + size


def packed(records: Iterable[tuple[int, bytes]]) -> bytes:
    """The uncompressed content of a recording with these times and frames."""
    return b"".join(struct.pack(">Q", time_us) + frame for time_us, frame in records)


def write_log(path: Path, records: Iterable[tuple[int, bytes]]) -> None:
    """Writes a recording. The same records always make the same file, compressed or not."""
    content = packed(records)
    if path.suffix == ".gz":
        content = gzip.compress(content, compresslevel=9, mtime=0)
    path.write_bytes(content)
