"""`ponte inspect --hex` shows every byte of a capture: frames, the console text between them, and what is neither."""

from __future__ import annotations

import gzip
from pathlib import Path

from programs import REPOSITORY, parse_json, run

CAPTURE = REPOSITORY / "tests" / "recordings" / "ap_boot_raw_datagrams.txt.gz"


def bytes_on_the_wire() -> bytes:
    """Every datagram of the capture, one after the other: each line is microseconds and hex."""
    lines = gzip.decompress(CAPTURE.read_bytes()).decode().splitlines()
    return b"".join(bytes.fromhex(line.split()[1]) for line in lines if line and not line.startswith("#"))


def test_every_byte_of_the_raw_datagrams_is_shown_once(ponte: Path) -> None:
    result = run([ponte, "inspect", CAPTURE, "--hex", "--json"])
    assert result.returncode == 0, result.stderr
    shown = [row for row in map(parse_json, result.stdout.splitlines()) if row["kind"] in ("frame", "text", "bytes")]
    assert b"".join(bytes.fromhex(row["hex"]) for row in shown) == bytes_on_the_wire()

    frames = [row for row in shown if row["kind"] == "frame"]
    assert len(frames) == bytes_on_the_wire().count(bytes.fromhex("fd090000")) > 0
    assert all(row["words"].startswith("0xFD HEARTBEAT system 1 component 1") for row in frames)
    text = " ".join(row["words"] for row in shown if row["kind"] == "text")
    assert "Init ArduCopter" in text and "Init Gyro" in text


def test_the_table_says_what_was_found(ponte: Path) -> None:
    result = run([ponte, "inspect", CAPTURE, "--hex"])
    assert result.returncode == 0, result.stderr
    assert "start byte 0xFD: 9" in result.stdout
    assert "HEARTBEAT" in result.stdout and "Init ArduCopter" in result.stdout
