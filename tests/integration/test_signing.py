"""Signed MAVLink 2 against pymavlink, both ways, and each kind of forged frame refused under its own reason."""

from __future__ import annotations

import hashlib
import os
import socket
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as dialect

import tlog
from programs import HANG_LIMIT_S, json_objects, run

PASSPHRASE = "gateway-test-passphrase"
KEY = hashlib.sha256(PASSPHRASE.encode()).digest()
WRONG_KEY = bytes(32)
# Of pymavlink's clock: units of 10 us since 2015.
UNITS_PER_S = 100_000
EPOCH_S = 1_420_070_400


def now_units() -> int:
    return int((time.time() - EPOCH_S) * UNITS_PER_S)


def signing_link(key: bytes, system: int = 255, component: int = 190, link_id: int = 7) -> dialect.MAVLink:
    """pymavlink, which signs what it packs and takes nothing unsigned."""
    link = dialect.MAVLink(None, srcSystem=system, srcComponent=component)
    link.signing.secret_key = key
    link.signing.link_id = link_id
    link.signing.timestamp = now_units()
    link.signing.sign_outgoing = True
    link.robust_parsing = True
    return link


def ping_for(number: int) -> dialect.MAVLink_message:
    """A question of our own kind: the vehicle mirrors the number."""
    return dialect.MAVLink_timesync_message(0, number)


@pytest.fixture
def key_file(tmp_path: Path) -> Path:
    path = tmp_path / "key"
    path.write_text(f"passphrase={PASSPHRASE}\n")
    path.chmod(0o600)
    return path


class Vehicle:
    """`ponte sim` that talks to a socket of ours."""

    def __init__(self, ponte: Path, *options: str | Path) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(HANG_LIMIT_S)
        endpoint = f"udpout://127.0.0.1:{self.socket.getsockname()[1]}"
        command = [ponte, "sim", "--endpoint", endpoint, *options]
        self.process = subprocess.Popen([str(part) for part in command], stderr=subprocess.PIPE, text=True)
        self.place = self.hear()[1]

    def hear(self) -> tuple[bytes, Any]:
        return self.socket.recvfrom(2048)

    def say(self, frame: bytes) -> None:
        self.socket.sendto(frame, self.place)

    def hear_answer(self, link: dialect.MAVLink, number: int) -> dialect.MAVLink_message:
        """Waits for the answer to a `ping_for`; `link` judges what comes."""
        while True:
            for message in link.parse_buffer(self.hear()[0]) or []:
                if message.get_type() == "TIMESYNC" and message.ts1 == number and message.tc1 != 0:
                    return message

    def end(self) -> str:
        self.process.terminate()
        log = self.process.communicate(timeout=HANG_LIMIT_S)[1]
        assert self.process.returncode == 0
        return log


@pytest.fixture
def vehicle(ponte: Path) -> Iterator[Callable[..., Vehicle]]:
    running: list[Vehicle] = []

    def start(*options: str | Path) -> Vehicle:
        running.append(Vehicle(ponte, *options))
        return running[-1]

    yield start
    for each in running:
        if each.process.poll() is None:
            each.process.kill()
        each.process.wait(HANG_LIMIT_S)


def test_pymavlink_verifies_what_the_vehicle_signs_and_the_other_way_round(
    vehicle: Callable[..., Vehicle], key_file: Path
) -> None:
    sim = vehicle("--signing-key", key_file, "--mavlink", "2-signed-only")
    link = signing_link(KEY)
    for number in (11, 12):
        sim.say(ping_for(number).pack(link))
        assert sim.hear_answer(link, number).get_signed()
    assert link.signing.goodsig_count > 0 and link.signing.badsig_count == 0
    assert "refused" not in sim.end()


def test_a_stranger_verifies_nothing(vehicle: Callable[..., Vehicle], key_file: Path) -> None:
    sim = vehicle("--signing-key", key_file)
    stranger = signing_link(WRONG_KEY)
    for _ in range(5):
        stranger.parse_buffer(sim.hear()[0])
    assert stranger.signing.badsig_count > 0 and stranger.signing.goodsig_count == 0


def test_each_forged_frame_is_refused_under_its_own_reason(vehicle: Callable[..., Vehicle], key_file: Path) -> None:
    sim = vehicle("--signing-key", key_file, "--mavlink", "2-signed-only")
    link = signing_link(KEY)
    replayed = ping_for(1).pack(link)
    sim.say(replayed)
    sim.hear_answer(link, 1)

    sim.say(replayed)
    sim.say(ping_for(2).pack(signing_link(WRONG_KEY)))
    delayed = signing_link(KEY, link_id=8)
    delayed.signing.timestamp = now_units() - 120 * UNITS_PER_S
    sim.say(ping_for(3).pack(delayed))
    unsigned = dialect.MAVLink(None, srcSystem=255, srcComponent=190)
    sim.say(ping_for(4).pack(unsigned))
    sim.say(ping_for(5).pack(unsigned, force_mavlink1=True))
    sim.say(dialect.MAVLink_radio_status_message(0, 0, 0, 0, 0, 0, 0).pack(unsigned))  # accepted unsigned

    sim.say(ping_for(6).pack(link))
    sim.hear_answer(link, 6)
    log = sim.end()
    assert "; refused: 1 unsigned, 1 downgraded, 1 wrong signature, 1 replayed, 1 too old\n" in log


def test_unsigned_frames_are_taken_until_the_first_signed_one(
    vehicle: Callable[..., Vehicle], key_file: Path
) -> None:
    sim = vehicle("--signing-key", key_file)
    link = signing_link(KEY)
    unsigned = dialect.MAVLink(None, srcSystem=254, srcComponent=190)
    sim.say(ping_for(1).pack(unsigned))
    sim.hear_answer(link, 1)
    sim.say(ping_for(2).pack(link))
    sim.hear_answer(link, 2)
    sim.say(ping_for(3).pack(unsigned))
    sim.say(ping_for(4).pack(unsigned, force_mavlink1=True))
    sim.say(ping_for(5).pack(link))
    sim.hear_answer(link, 5)
    assert "; refused: 1 unsigned, 1 downgraded\n" in sim.end()


def test_the_vsm_and_a_signing_vehicle_understand_one_another(ponte: Path, key_file: Path) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as station:
        station.bind(("127.0.0.1", 0))
        station.settimeout(HANG_LIMIT_S)
        endpoint = f"udpout://127.0.0.1:{station.getsockname()[1]}"
        command = [ponte, "vsm", "--vehicle", endpoint, "--signing-key", key_file, "--mavlink", "2-signed-only", "--json"]
        vsm = subprocess.Popen(
            [str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        judge = signing_link(KEY, system=1, component=1)
        frame, place = station.recvfrom(2048)
        (greeting,) = judge.parse_buffer(frame) or []
        assert greeting.get_type() == "HEARTBEAT" and greeting.get_signed()

        forger = signing_link(WRONG_KEY, system=2, component=1)
        for link in (forger, judge):
            station.sendto(dialect.MAVLink_heartbeat_message(2, 3, 81, 0, 3, 3).pack(link), place)
        asked = None
        while asked is None or asked.get_type() == "HEARTBEAT":
            (asked,) = judge.parse_buffer(station.recv(2048)) or []
            assert asked.get_signed()
        assert asked.target_system == 1
        station.sendto(dialect.MAVLink_attitude_message(1000, 0.5, 0, 0, 0, 0, 0).pack(judge), place)
        assert vsm.stdout is not None
        while '"roll"' not in vsm.stdout.readline():
            pass
        vsm.terminate()
        log = vsm.communicate(timeout=HANG_LIMIT_S)[1]
    assert vsm.returncode == 0
    assert "vehicle appeared: system 1" in log and "system 2" not in log
    assert "frames are refused: wrong signature" in log and "; refused: 1 wrong signature" in log


@pytest.mark.parametrize("is_local", [True, False])
def test_a_key_is_taken_from_a_local_link_only(vehicle: Callable[..., Vehicle], is_local: bool) -> None:
    sim = vehicle(*(["--local"] if is_local else []))
    unsigned = dialect.MAVLink(None, srcSystem=255, srcComponent=190)
    sim.say(dialect.MAVLink_setup_signing_message(1, 1, KEY, now_units()).pack(unsigned))
    link = signing_link(KEY)
    judge = link if is_local else unsigned
    sim.say(ping_for(1).pack(judge))
    assert sim.hear_answer(judge, 1).get_signed() == is_local
    sim.end()


def test_the_time_does_not_go_back_between_two_runs(vehicle: Callable[..., Vehicle], key_file: Path) -> None:
    # A day ahead of the clock, as the last run might have left it; the other slot is torn.
    stored = now_units() + 86_400 * UNITS_PER_S
    slot = stored.to_bytes(8, "little") + (stored ^ (2**64 - 1)).to_bytes(8, "little")
    time_file = key_file.with_name("key.time")
    time_file.write_bytes(slot + slot[:9] + bytes(7))
    sim = vehicle("--signing-key", key_file)
    frame = sim.hear()[0]
    assert frame[0] == 0xFD
    assert int.from_bytes(frame[-12:-6], "little") > stored
    assert "was not written to its end" in sim.end()
    times = [int.from_bytes(time_file.read_bytes()[at : at + 8], "little") for at in (0, 16)]
    assert max(times) > stored


@pytest.mark.parametrize("mode", [0o640, 0o604, 0o660])
def test_a_key_that_others_may_read_is_refused(ponte: Path, key_file: Path, mode: int) -> None:
    key_file.chmod(mode)
    done = run([ponte, "vsm", "--vehicle", "udpin://127.0.0.1:0", "--signing-key", key_file])
    assert done.returncode == 1
    assert done.stderr == f"{key_file}: others may use it; expected a file of its owner alone: chmod 600\n"


def test_no_error_repeats_what_the_key_file_holds(ponte: Path, key_file: Path) -> None:
    key_file.write_text("almost-a-secret")
    done = run([ponte, "sim", "--signing-key", key_file])
    assert done.returncode == 1
    assert "expected 32 bytes, 64 hex digits or passphrase=WORDS" in done.stderr
    assert "almost" not in done.stderr + done.stdout


@pytest.mark.parametrize(
    "options",
    [
        ["--mavlink", "2-signed-only"],
        ["--unsigned", "all"],
        ["--mavlink", "0.9", "--signing-key", "KEY"],
        ["--mavlink", "1", "--signing-key", "KEY"],
        ["--mavlink", "2-signed-only", "--signing-key", "KEY", "--unsigned", "all"],
        ["--signing-key", "KEY", "--unsigned", "NO_SUCH_MESSAGE"],
    ],
)
def test_options_that_contradict_one_another_are_bad_usage(ponte: Path, key_file: Path, options: list[str]) -> None:
    done = run([ponte, "sim", *(str(key_file) if part == "KEY" else part for part in options)])
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1


def test_the_key_may_come_from_the_environment(ponte: Path, tmp_path: Path) -> None:
    log = tmp_path / "signed.tlog"
    tlog.write_log(log, [(int(time.time() * 1e6), ping_for(1).pack(signing_link(KEY)))])
    command = [str(ponte), "inspect", str(log)]
    for content, verdict in ((KEY.hex(), "accepted: 1"), (f"passphrase={PASSPHRASE}", "accepted: 1"), ("00" * 32, "wrong")):
        done = subprocess.run(
            command, env={**os.environ, "PONTE_SIGNING_KEY": content}, capture_output=True, text=True, check=True
        )
        assert verdict in done.stdout


def expected_verdicts(records: list[tlog.Record]) -> dict[str, int]:
    """What the rules say of each signed frame, by hashlib and a table of our own."""
    newest: dict[tuple[int, int, int], int] = {}
    own = 0
    counts = dict.fromkeys(("accepted", "wrong signature", "replayed", "too old"), 0)
    for record in records:
        frame = record.frame
        if frame[0] != 0xFD or not frame[2] & tlog.SIGNED_FLAG:
            continue
        stamp = int.from_bytes(frame[-12:-6], "little")
        stream = (frame[5], frame[6], frame[-13])
        if hashlib.sha256(KEY + frame[:-6]).digest()[:6] != frame[-6:]:
            counts["wrong signature"] += 1
            continue
        own = max(own, record.time_us // 10 - EPOCH_S * UNITS_PER_S)
        if stream in newest and stamp <= newest[stream]:
            counts["replayed"] += 1
        elif stream not in newest and stamp < own - 60 * UNITS_PER_S:
            counts["too old"] += 1
        else:
            counts["accepted"] += 1
            newest[stream] = stamp
            own = max(own, stamp)
    return {verdict: count for verdict, count in counts.items() if count}


def test_a_recording_of_ardupilot_verifies(ponte: Path, key_file: Path, repository: Path) -> None:
    path = repository / "tests" / "recordings" / "ap_signing_v2_trimmed.tlog.gz"
    expected = expected_verdicts(list(tlog.read_records(path)))
    assert expected["accepted"] > 100 and len(expected) > 2
    found = {
        line["verdict"]: line["count"]
        for line in json_objects([ponte, "inspect", path, "--json", "--signing-key", key_file])
        if line["kind"] == "signatures"
    }
    assert found == expected


def test_frames_whose_signature_is_not_right_are_not_translated(ponte: Path, key_file: Path, tmp_path: Path) -> None:
    start_us = int(time.time() * 1e6)
    judge, forger = signing_link(KEY, 1, 1), signing_link(WRONG_KEY, 1, 1)
    heartbeat = dialect.MAVLink_heartbeat_message(2, 3, 81, 0, 3, 3)
    attitudes = [dialect.MAVLink_attitude_message(1000 * n, roll, 0, 0, 0, 0, 0) for n, roll in ((1, 0.1), (2, 0.2))]
    frames = [heartbeat.pack(judge), attitudes[0].pack(judge), attitudes[1].pack(forger)]
    log = tmp_path / "signed.tlog"
    tlog.write_log(log, [(start_us + n, frame) for n, frame in enumerate(frames)])
    for options, count in (([], 2), (["--signing-key", key_file], 1)):
        lines = list(json_objects([ponte, "translate", log, "--json", "--quiet", *options]))
        assert sum("roll" in line["fields"] for line in lines) == count
