"""`ponte sim` before MAVProxy, which is typed to as a person would."""

from __future__ import annotations

import os
import re
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from programs import HANG_LIMIT_S

pytestmark = pytest.mark.once

MISSION = """QGC WPL 110
0\t1\t0\t16\t0\t0\t0\t0\t-30.06898\t-51.12179\t50\t1
1\t0\t3\t22\t0\t0\t0\t0\t-30.06898\t-51.12179\t20\t1
2\t0\t3\t16\t0\t0\t0\t0\t-30.0685\t-51.12179\t20\t1
3\t0\t3\t16\t0\t0\t0\t0\t-30.0685\t-51.1213\t20\t1
4\t0\t3\t21\t0\t0\t0\t0\t-30.06898\t-51.12179\t0\t1
"""


class Mavproxy:
    """MAVProxy on a vehicle, with everything that it has printed."""

    def __init__(self, port: int, folder: Path) -> None:
        program = Path(sys.executable).with_name("mavproxy.py")
        command = [sys.executable, str(program), f"--master=udpin:127.0.0.1:{port}", "--nowait", "--default-modules=wp,param,mode,arm,cmdlong,misc"]
        self.process = subprocess.Popen(
            command, cwd=folder, env={**os.environ, "HOME": str(folder), "TERM": "dumb"}, text=True, errors="replace",
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, bufsize=1,
        )  # fmt: skip
        self.printed = ""
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        assert self.process.stdout is not None
        while text := self.process.stdout.read(1):
            self.printed += text

    def type(self, line: str) -> None:
        assert self.process.stdin is not None
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()

    def until(self, pattern: str, typed: str | None = None) -> None:
        """Types the line, again every two seconds, until what is printed from then on matches; without a line, until
        anything that has been printed does."""
        start = 0 if typed is None else len(self.printed)
        end, again = time.monotonic() + HANG_LIMIT_S, 0.0
        while not re.search(pattern, self.printed[start:]):
            assert time.monotonic() < end and self.process.poll() is None, self.printed[-3000:]
            if typed is not None and time.monotonic() >= again:
                self.type(typed)
                again = time.monotonic() + 2
            time.sleep(0.05)


@pytest.fixture
def mavproxy(start_ponte: Callable[..., None], tmp_path: Path) -> Iterator[Mavproxy]:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    start_ponte("sim", "--endpoint", f"udpout://127.0.0.1:{port}", "--speedup", "5", "--quiet")
    result = Mavproxy(port, tmp_path)
    yield result
    result.process.kill()
    result.process.wait(HANG_LIMIT_S)


def test_it_flies_a_waypoint_file(mavproxy: Mavproxy, tmp_path: Path) -> None:
    mavproxy.until(r"Received \d+ parameters")
    (tmp_path / "mission.txt").write_text(MISSION)
    mavproxy.until(r"EKF3 IMU0 is using GPS")
    mavproxy.until(r"Loaded 5 waypoints", "wp load mission.txt")
    mavproxy.until(r"Flight plan received")
    mavproxy.until(r"Saved 5 waypoints to saved.txt", "wp save saved.txt")
    saved = [line.split("\t") for line in (tmp_path / "saved.txt").read_text().splitlines()[1:]]
    wanted = [line.split("\t") for line in MISSION.splitlines()[1:]]
    for got, expected in zip(saved[1:], wanted[1:], strict=True):  # item 0 is the vehicle's own home
        assert [float(value) for value in got[2:4]] == [float(value) for value in expected[2:4]]
        assert [float(value) for value in got[8:11]] == pytest.approx([float(value) for value in expected[8:11]], abs=1e-6)

    mavproxy.until(r"Mode GUIDED|GUIDED>", "mode guided")
    mavproxy.until(r"Arming motors|ARMED", "arm throttle")
    mavproxy.until(r"AUTO>|Mode AUTO", "mode auto")
    mavproxy.until(r"Mission: 1 Takeoff", "long MISSION_START 0 0")
    mavproxy.until(r"Reached command #3")
    mavproxy.until(r"Disarming motors|DISARMED")
