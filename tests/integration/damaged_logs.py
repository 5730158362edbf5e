"""Damages recordings in ways that leave a usable part, and makes files that are no recordings at all."""

from __future__ import annotations

import gzip
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import tlog

PNG_HEADER = bytes.fromhex("89504e470d0a1a0a0000000d49484452000000100000001008060000001ff3ff61")
RANDOM_TEXT = b"The quick brown fox jumps over the lazy dog.\n" * 40
GARBAGE = bytes(range(0x20, 0x60))


class Damaged(NamedTuple):
    """A damaged recording and how many bytes of its uncompressed content come before the damage."""

    name: str
    content: bytes
    usable: int


def inflated(part: bytes) -> bytes:
    """All that can be got out of the beginning of a gzip file."""
    return zlib.decompressobj(wbits=31).decompress(part)


def middle_record(content: bytes, path: Path) -> tlog.Record:
    """The first whole record in the second half."""
    return next(record for record in tlog.read_records(path) if record.offset >= len(content) // 2)


def cut_plain(path: Path) -> Damaged:
    """An uncompressed recording that ends inside a frame."""
    content = gzip.decompress(path.read_bytes())
    record = middle_record(content, path)
    return Damaged("cut.tlog", content[: record.offset + tlog.TIME_SIZE + 5], record.offset)


def cut_time(path: Path) -> Damaged:
    """An uncompressed recording that ends inside the time of a record."""
    content = gzip.decompress(path.read_bytes())
    record = middle_record(content, path)
    return Damaged("cut_time.tlog", content[: record.offset + 3], record.offset)


def cut_compressed(path: Path) -> Damaged:
    """A compressed recording of which the second half is missing."""
    packed = path.read_bytes()
    half = packed[: len(packed) // 2]
    return Damaged("cut.tlog.gz", half, len(inflated(half)))


def overwritten(path: Path) -> Damaged:
    """A compressed recording with bytes overwritten in the middle."""
    packed = path.read_bytes()
    half = len(packed) // 2
    return Damaged("overwritten.tlog.gz", packed[:half] + b"\xff" * 64 + packed[half + 64 :], len(inflated(packed[:half])))


def wrong_trailer(path: Path) -> Damaged:
    """A compressed recording whose own checksum is wrong while its content is whole."""
    packed = path.read_bytes()
    trailer = bytes(byte ^ 0xFF for byte in packed[-8:-4])
    return Damaged("wrong_trailer.tlog.gz", packed[:-8] + trailer + packed[-4:], len(gzip.decompress(packed)))


def with_garbage(path: Path) -> Damaged:
    """An uncompressed recording with bytes between two records that are neither time nor frame."""
    content = gzip.decompress(path.read_bytes())
    at = middle_record(content, path).offset
    return Damaged("garbage.tlog", content[:at] + GARBAGE + content[at:], at)


DAMAGES: list[Callable[[Path], Damaged]] = [cut_plain, cut_time, cut_compressed, overwritten, wrong_trailer, with_garbage]

NO_RECORDINGS: dict[str, bytes] = {
    "empty.tlog": b"",
    "empty.tlog.gz": gzip.compress(b"", mtime=0),
    "picture.tlog": PNG_HEADER,
    "text.tlog": RANDOM_TEXT,
    "text.tlog.gz": gzip.compress(RANDOM_TEXT, mtime=0),
    "no_gzip.tlog.gz": RANDOM_TEXT,
    "gzip_header_alone.tlog.gz": gzip.compress(RANDOM_TEXT, mtime=0)[:10],
    "gzip_header_and_junk.tlog.gz": gzip.compress(b"", mtime=0)[:10] + b"\xff" * 500,
    "five_bytes.tlog": bytes(5),
}
