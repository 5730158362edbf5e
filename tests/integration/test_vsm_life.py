"""What happens to `ponte vsm` while it runs: plugs are pulled, vehicles die and come back, two use one id, recordings end.

Every wait is for a line or a datagram that must come; nothing here depends on how fast the machine is.
"""

from __future__ import annotations

import json
import queue
import re
import signal
import socket
import subprocess
import threading
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

PATIENCE_S = 60.0
INERTIAL_STATES = 4000
ALERT = 16000
RECORDINGS = ["ap_mission_v2_trimmed.tlog.gz", "px4_mission_v2_trimmed.tlog.gz", "ap_boot_raw_datagrams.txt.gz"]


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


class Program:
    """A running ponte, whose lines are read as they come."""

    def __init__(self, *command: object) -> None:
        self.process = subprocess.Popen(
            [str(part) for part in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self.log: queue.Queue[str] = queue.Queue()
        self.out: queue.Queue[str] = queue.Queue()
        for stream, lines in ((self.process.stderr, self.log), (self.process.stdout, self.out)):
            threading.Thread(target=self._read, args=(stream, lines), daemon=True).start()

    @staticmethod
    def _read(stream: Any, lines: queue.Queue[str]) -> None:
        for line in stream:
            lines.put(line.rstrip())

    def wait_for_log(self, pattern: str) -> str:
        """The next line that matches; those before it are read away."""
        seen = []
        try:
            while True:
                seen.append(self.log.get(timeout=PATIENCE_S))
                if re.search(pattern, seen[-1]):
                    return seen[-1]
        except queue.Empty:
            pytest.fail(f"no line {pattern!r} after {seen}")

    def wait_for_message(self, number: int, wanted: Callable[[dict[str, Any]], bool] = lambda _: True) -> dict[str, Any]:
        try:
            while True:
                message: dict[str, Any] = json.loads(self.out.get(timeout=PATIENCE_S))
                if message["number"] == number and wanted(message):
                    return message
        except queue.Empty:
            pytest.fail(f"no message #{number}")

    def forget_messages(self) -> None:
        while not self.out.empty():
            self.out.get()

    def end(self) -> int:
        self.process.send_signal(signal.SIGTERM)
        return self.process.wait(PATIENCE_S)


@pytest.fixture
def start(ponte: Path) -> Iterator[Callable[..., Program]]:
    running: list[Program] = []

    def begin(*arguments: object) -> Program:
        running.append(Program(ponte, *arguments))
        return running[-1]

    yield begin
    for program in running:
        program.process.kill()
        program.process.wait()


def has_roll(message: dict[str, Any]) -> bool:
    return "roll" in message["fields"]


def test_a_serial_port_may_be_unplugged_and_plugged_in_again(start: Callable[..., Program], tmp_path: Path) -> None:
    port = tmp_path / "ttyVehicle"
    vsm = start("vsm", "--vehicle", f"serial://{port}:57600", "--json", "--every-sample")
    line = vsm.wait_for_log("is down")
    assert f"{port} is missing; " in line
    assert re.search(r"(ports here: /dev/|no serial ports here)", line)
    for round_number in range(2):
        vehicle = start("sim", "--pty", port)
        vsm.wait_for_log(rf"serial://{port}:57600 is up")
        vsm.wait_for_log("vehicle appeared" if round_number == 0 else "vehicle (returned|rebooted)")
        vsm.forget_messages()
        vsm.wait_for_message(INERTIAL_STATES, has_roll)
        assert vehicle.end() == 0
        vsm.wait_for_log("is down")
    assert vsm.end() == 0


def test_a_vehicle_may_be_killed_and_started_again(start: Callable[..., Program]) -> None:
    port = free_port()
    vsm = start("vsm", "--vehicle", f"udpin://127.0.0.1:{port}", "--json", "--every-sample")
    vsm.wait_for_log("is up")
    first = start("sim", "--endpoint", f"udpout://127.0.0.1:{port}")
    vsm.wait_for_log("vehicle appeared: system 1")
    vsm.wait_for_message(INERTIAL_STATES, has_roll)
    first.process.kill()
    vsm.wait_for_log("vehicle lost: system 1")
    vsm.forget_messages()
    start("sim", "--endpoint", f"udpout://127.0.0.1:{port}", "--seed", 2)
    vsm.wait_for_log("vehicle (returned|rebooted): system 1")
    vsm.wait_for_message(INERTIAL_STATES, has_roll)  # its streams were asked for anew
    assert vsm.end() == 0


def test_of_two_vehicles_with_one_id_the_second_is_left_out_and_told_of(start: Callable[..., Program]) -> None:
    ports = [free_port(), free_port()]
    vsm = start("vsm", *(f"--vehicle=udpin://127.0.0.1:{port}" for port in ports), "--json", "--every-sample")
    vsm.wait_for_log("is up")
    start("sim", "--endpoint", f"udpout://127.0.0.1:{ports[0]}", "--home", "10,20,30")
    vsm.wait_for_log("vehicle appeared: system 1")
    start("sim", "--endpoint", f"udpout://127.0.0.1:{ports[1]}", "--home", "-40,50,60")
    vsm.wait_for_log("two vehicles use one id, the second is left out: system 1")
    alert = vsm.wait_for_message(ALERT, lambda message: "one MAVLink id" in str(message["fields"]["text"]["raw"]))
    assert alert["source"] == "14:40:00:01"
    for _ in range(20):
        message = vsm.wait_for_message(INERTIAL_STATES, lambda message: "latitude" in message["fields"])
        assert message["fields"]["latitude"]["value"] == pytest.approx(0.1745, abs=0.001), "the first vehicle's place"
    assert vsm.end() == 0


def test_two_vehicles_on_one_link_are_kept_apart(start: Callable[..., Program]) -> None:
    port = free_port()
    vsm = start("vsm", "--vehicle", f"udpin://127.0.0.1:{port}", "--json", "--owning-id", 33)
    vsm.wait_for_log("is up")
    for system in (3, 4):
        start("sim", "--endpoint", f"udpout://127.0.0.1:{port}", "--system", system)
    for source in ("21:40:00:03", "21:40:00:04"):
        vsm.wait_for_message(INERTIAL_STATES, lambda message, source=source: message["source"] == source)
    assert vsm.end() == 0


@pytest.mark.parametrize("name", RECORDINGS)
def test_a_replayed_recording_says_what_translate_says(ponte: Path, repository: Path, name: str) -> None:
    recording = repository / "tests" / "recordings" / name
    translated = subprocess.run([ponte, "translate", recording, "--json"], check=True, capture_output=True).stdout
    replayed = subprocess.run(
        [ponte, "vsm", "--vehicle", f"file://{recording}?speed=100", "--json"], check=True, capture_output=True
    ).stdout
    assert translated.count(b"\n") > 10
    assert replayed == translated


def test_a_recording_in_real_time_goes_out_as_datagrams(start: Callable[..., Program], repository: Path) -> None:
    """A piece of a flight at the speed at which it was flown, heard on a socket."""
    recording = repository / "tests" / "recordings" / "ap_mission_v2_trimmed.tlog.gz"
    station = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    station.bind(("127.0.0.1", 0))
    station.settimeout(PATIENCE_S)
    vsm = start("vsm", "--vehicle", f"file://{recording}", "--dli", f"udpout://127.0.0.1:{station.getsockname()[1]}", "--json")
    for _ in range(50):
        datagram = station.recv(2048)
        message = json.loads(vsm.out.get(timeout=PATIENCE_S))
        assert int.from_bytes(datagram[12:14], "big") == message["number"]
    assert vsm.end() == 0


def test_a_configuration_file_says_what_options_say(start: Callable[..., Program], ponte: Path, tmp_path: Path) -> None:
    port = free_port()
    config = tmp_path / "ponte.toml"
    config.write_text(f'[vsm]\nvehicle = ["udpin://127.0.0.1:{port}"]\nowning-id = 33\nvsm-id = 7\njson = true\n')
    vsm = start("vsm", "--config", config)
    assert vsm.wait_for_message(16002)["source"] == "21:60:00:07"
    assert vsm.end() == 0
    config.write_text("[vsm]\nowner = 33\n")
    wrong = subprocess.run([ponte, "--config", config, "vsm"], capture_output=True, text=True, check=False)
    assert wrong.returncode == 2
    assert "vsm.owner" in wrong.stderr


def test_a_port_that_is_taken_is_named(start: Callable[..., Program], ponte: Path) -> None:
    port = free_port()
    start("vsm", "--vehicle", f"udpin://127.0.0.1:{port}").wait_for_log("is up")
    second = subprocess.run(
        [ponte, "vsm", "--vehicle", f"udpin://127.0.0.1:{port}"], capture_output=True, text=True, check=False
    )
    assert second.returncode == 1
    assert re.fullmatch(rf"udpin://127.0.0.1:{port}: .*in use\n", second.stderr, re.IGNORECASE)


def test_garbage_is_counted_by_reason(start: Callable[..., Program]) -> None:
    port = free_port()
    vsm = start("vsm", "--vehicle", f"udpin://127.0.0.1:{port}", "--json")
    vsm.wait_for_log("is up")
    sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    for _ in range(1000):
        sender.sendto(b"\x00" * 100, ("127.0.0.1", port))
        sender.sendto(b"\xfd\x01\x00\x00\x00\x01\x01\x00\x00\x00\x00\x00\x00", ("127.0.0.1", port))
    vehicle = start("sim", "--endpoint", f"udpout://127.0.0.1:{port}")
    vsm.wait_for_message(INERTIAL_STATES)  # what came before it has been read, or was dropped by the kernel and counted
    assert vehicle.end() == 0
    vsm.process.send_signal(signal.SIGTERM)
    line = vsm.wait_for_log(r"bytes skipped")
    counted = re.search(r"(\d+) noise, (\d+) checksum", line)
    assert counted, line
    assert int(counted[1]) >= 100 * 500
    assert int(counted[2]) >= 500
