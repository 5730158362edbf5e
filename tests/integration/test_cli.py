"""What `ponte translate` does with bad input and bad usage, and what it writes for Wireshark."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import mavlink_frames
import tlog
from damaged_logs import DAMAGES, NO_RECORDINGS, Damaged
from dli_reader import Message, decode_datagram, identifier_text
from inertial_judge import ATTITUDE, AUTOPILOT_SYSTEM, NAMES
from pcap_reader import Packet, read_udp
from programs import json_objects, parse_json, run
from recordings_found import OWN_FOLDER

RECORDING = OWN_FOLDER / "ap_mission_v2_trimmed.tlog.gz"
OFFSET = re.compile(r"\b(offset|byte)\b\D{0,10}\d+", re.IGNORECASE)
WORDS_OF_A_REASON = 2


def check_refusal(ponte: Path, path: Path) -> None:
    """Status 1, nothing on stdout, and one line that names the file and says more than its name."""
    finished = run([ponte, "translate", path, "--json"])
    assert (finished.returncode, finished.stdout) == (1, ""), finished.stderr
    lines = finished.stderr.splitlines()
    assert len(lines) == 1, finished.stderr
    assert path.name in lines[0]
    reason = lines[0].replace(str(path), " ").replace(path.name, " ")
    assert len(re.findall(r"[A-Za-z]{2,}", reason)) >= WORDS_OF_A_REASON, f"no reason in {lines[0]!r}"


@pytest.mark.parametrize("name", sorted(NO_RECORDINGS))
def test_a_file_that_is_no_recording_is_refused(ponte: Path, tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    path.write_bytes(NO_RECORDINGS[name])
    check_refusal(ponte, path)


def test_a_missing_file_is_refused(ponte: Path, tmp_path: Path) -> None:
    check_refusal(ponte, tmp_path / "missing.tlog")


def test_a_folder_is_refused(ponte: Path, tmp_path: Path) -> None:
    folder = tmp_path / "folder.tlog"
    folder.mkdir()
    check_refusal(ponte, folder)


def attitudes_before(path: Path, usable: int) -> int:
    """How many ATTITUDE of the autopilot lie wholly in the first bytes of a recording."""
    count = 0
    for record in tlog.read_records(path):
        if record.offset + tlog.TIME_SIZE + len(record.frame) > usable:
            break
        frame = mavlink_frames.parse(record.frame)
        count += (frame.system, frame.message_id) == (AUTOPILOT_SYSTEM, ATTITUDE)
    return count


def with_roll(objects: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [o for o in objects if o["number"] == 4000 and "roll" in o["fields"]]


@pytest.mark.parametrize("damage", DAMAGES)
def test_the_usable_part_of_a_damaged_file_is_translated(
    ponte: Path, tmp_path: Path, damage: Callable[[Path], Damaged]
) -> None:
    damaged = damage(RECORDING)
    path = tmp_path / damaged.name
    path.write_bytes(damaged.content)
    finished = run([ponte, "translate", path, "--json"])
    assert finished.returncode == 0, finished.stderr
    complaints = [line for line in finished.stderr.splitlines() if damaged.name in line]
    assert complaints and OFFSET.search(complaints[0].replace(str(path), "")), f"no offset in {finished.stderr!r}"

    sound = attitudes_before(RECORDING, damaged.usable)
    got = with_roll([parse_json(line) for line in finished.stdout.splitlines()])
    whole = with_roll(list(json_objects([ponte, "translate", RECORDING, "--json"])))
    assert sound > 0
    assert len(got) >= sound, "a part of the file that could be read was not translated"
    assert got[:sound] == whole[:sound]


@pytest.mark.parametrize("arguments", [["translate"], ["translate", "--no-such-option", str(RECORDING)], ["no-such-command"],
                                       ["translate", str(RECORDING), "one too many"],
                                       ["translate", str(RECORDING), "--pcap"]])  # fmt: skip
def test_bad_usage_ends_with_status_2(ponte: Path, arguments: list[str]) -> None:
    finished = run([ponte, *arguments])
    assert finished.returncode == 2, finished.stderr
    assert finished.stdout == ""
    assert finished.stderr.strip()


@pytest.fixture(scope="module")
def capture(ponte: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The recording translated for Wireshark."""
    path = tmp_path_factory.mktemp("capture") / "flight.pcap"
    finished = run([ponte, "translate", RECORDING, "--pcap", path])
    assert finished.returncode == 0, finished.stderr
    return path


def raws_of_4000(message: Message) -> dict[str, Any]:
    return {name: message.fields[number].raw for number, name in NAMES.items() if number in message.fields}


def test_the_capture_holds_the_messages_that_json_shows(ponte: Path, capture: Path) -> None:
    packets: list[Packet] = list(read_udp(capture))
    read = [message for packet in packets for message in decode_datagram(packet.payload)]
    shown = list(json_objects([ponte, "translate", RECORDING, "--json"]))
    assert packets and len(read) == len(shown)
    for message, told in zip(read, shown):
        wrapped = message.wrapped
        read_wrapper = {
            "number": message.number,
            "edition": message.edition,
            "source": identifier_text(wrapped.source),
            "destination": identifier_text(wrapped.destination),
        }
        assert read_wrapper == {key: told[key] for key in read_wrapper}
        assert len(message.fields) == len(told["fields"])
        assert not message.unknown_bits
        if message.number == 4000:
            told_raws = {name: told["fields"][name]["raw"] for name in NAMES.values() if name in told["fields"]}
            assert raws_of_4000(message) == told_raws


@pytest.mark.skipif(shutil.which("tshark") is None, reason="tshark is not installed")
def test_tshark_reads_the_capture(capture: Path) -> None:
    finished = run(["tshark", "-n", "-r", capture, "-T", "fields", "-e", "frame.protocols", "-e", "udp.payload"])
    assert finished.returncode == 0, finished.stderr
    rows = [line.split("\t") for line in finished.stdout.splitlines()]
    assert [protocols for protocols, _ in rows if ":udp" not in protocols] == []
    payloads = [bytes.fromhex(payload.replace(":", "")) for _, payload in rows]
    assert payloads == [packet.payload for packet in read_udp(capture)]
