"""`ponte demo`: with and without a window, and what it says when there is nothing to see."""

from __future__ import annotations

import fcntl
import os
import pty
import re
import select
import struct
import subprocess
import termios
import time
from pathlib import Path

PATIENCE_S = 60.0


def run(ponte: Path, *options: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [ponte, "demo", *options], capture_output=True, text=True, timeout=PATIENCE_S, check=False
    )


def test_both_sides_are_seen_and_agree(ponte: Path) -> None:
    result = run(ponte, "--headless", "--seconds", "8", "--quiet")
    assert result.returncode == 0, result.stdout + result.stderr
    assert result.stderr == ""
    compared, different = map(int, re.findall(r"compared +(\d+) attitudes, (\d+) differ", result.stdout)[0])
    assert compared > 0
    assert different == 0


def test_without_a_vehicle_it_fails_and_says_why(ponte: Path) -> None:
    result = run(ponte, "--headless", "--seconds", "0.5", "--vehicle", "udpin://127.0.0.1:0", "--quiet")
    assert result.returncode == 1
    assert result.stderr == "ponte demo: no MAVLink frame was received\n"


def test_without_a_terminal_it_names_the_way(ponte: Path) -> None:
    result = run(ponte, "--seconds", "1")
    assert result.returncode == 1
    assert result.stderr == "ponte demo: this is no terminal; --headless runs without one\n"


class Window:
    """The demo in a terminal of its own; `text` is all that it has written."""

    def __init__(self, ponte: Path) -> None:
        self.master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("4H", 24, 80, 0, 0))
        self.process = subprocess.Popen([ponte, "demo"], stdin=slave, stdout=slave, stderr=slave)
        os.close(slave)
        self.text = ""

    def wait_for(self, pattern: str) -> None:
        deadline = time.monotonic() + PATIENCE_S
        while not re.search(pattern, self.text):
            assert time.monotonic() < deadline, f"no {pattern!r} in {self.text[-3000:]}"
            assert select.select([self.master], [], [], PATIENCE_S)[0], f"no {pattern!r} in {self.text[-3000:]}"
            self.text += os.read(self.master, 65536).decode()

    def press(self, key: str) -> None:
        self.text = ""
        os.write(self.master, key.encode())


def test_the_window_shows_both_sides_and_has_a_switch(ponte: Path) -> None:
    window = Window(ponte)
    try:
        window.wait_for(r"STANAG 4586")
        window.wait_for(r"hex  ff  ff  00")
        window.wait_for(r"presence  [0-9a-f]{2} [0-9a-f]{2} [0-9a-f]{2}")
        window.wait_for(r"roll +-?\d+ +[0-9a-f]{4} +-?\d\.\d{6} +-?\d+\.\d{4}")
        window.press("c")
        window.wait_for(r"conversion is off")
        window.press("c")
        window.wait_for(r"conversion ON[^\0]*presence  ")
        window.press("q")
        window.wait_for(r"compared +\d+ attitudes, 0 differ")
        assert window.process.wait(PATIENCE_S) == 0
    finally:
        window.process.kill()
        os.close(window.master)
