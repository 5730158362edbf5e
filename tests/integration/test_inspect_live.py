"""`ponte inspect ENDPOINT`: both languages, counted by pymavlink's and the independent encoder's own tally."""

from __future__ import annotations

import json
import signal
import socket
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as dialect

PATIENCE_S = 60.0


class Listener:
    """An inspector on a UDP port, and a socket that talks to it."""

    def __init__(self, ponte: Path, *options: str) -> None:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
            probe.bind(("127.0.0.1", 0))
            self.place = probe.getsockname()
        command = [ponte, "inspect", f"udpin://127.0.0.1:{self.place[1]}", *options]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        assert self.process.stderr is not None
        assert self.process.stderr.readline().rstrip().endswith("is up")
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)

    def say(self, datagram: bytes) -> None:
        self.socket.sendto(datagram, self.place)

    def waiting_bytes(self) -> int:
        """What the inspector has not read yet, by the kernel's table of sockets."""
        for line in Path("/proc/net/udp").read_text().splitlines()[1:]:
            _, local, _, _, queues, *_ = line.split()
            if int(local.split(":")[1], 16) == self.place[1]:
                return int(queues.split(":")[1], 16)
        return 0

    def lines(self) -> list[dict[str, Any]]:
        """Ends the inspector, and returns what it has to say."""
        while self.waiting_bytes() > 0:
            time.sleep(0.01)
        self.process.send_signal(signal.SIGINT)
        out, _ = self.process.communicate(timeout=PATIENCE_S)
        assert self.process.returncode == 0
        return [json.loads(line) for line in out.splitlines()]


@pytest.fixture
def listeners(ponte: Path) -> Iterator[Any]:
    running: list[Listener] = []

    def start(*options: str) -> Listener:
        running.append(Listener(ponte, *options))
        return running[-1]

    yield start
    for listener in running:
        listener.process.kill()
        listener.socket.close()


def attitude(link: Any, roll: float) -> bytes:
    frame = bytes(dialect.MAVLink_attitude_message(0, roll, 0, 0, 0, 0, 0).pack(link))
    link.seq = (link.seq + 1) % 256
    return frame


def dli_message(ponte: Path, repository: Path, folder: Path) -> bytes:
    """The first datagram that the VSM says of a recording, from a capture of it."""
    capture = folder / "flight.pcap"
    recording = repository / "tests/recordings/ap_mission_v2_trimmed.tlog.gz"
    subprocess.run([ponte, "translate", recording, "--pcap", capture, "--quiet"], check=True)
    data = capture.read_bytes()
    size = int.from_bytes(data[24 + 8 : 24 + 12], "little")
    return data[40 + 28 : 40 + size]  # behind the headers of file, packet, IP and UDP


def test_both_languages_are_counted(listeners: Any, ponte: Path, repository: Path, tmp_path: Path) -> None:
    listener = listeners("--json")
    link = dialect.MAVLink(None, srcSystem=7, srcComponent=1)
    for index in range(10):
        frame = attitude(link, index / 10)
        if index != 4:  # one is lost
            listener.say(frame)
    listener.say(b"noise")
    message = dli_message(ponte, repository, tmp_path)
    listener.say(message)
    listener.say(message[:-1] + bytes([message[-1] ^ 0xFF]))  # a wrong checksum
    lines = listener.lines()
    of_kind = {line["kind"]: line for line in lines}
    assert of_kind["message"]["name"] == "ATTITUDE"
    assert (of_kind["message"]["system"], of_kind["message"]["count"]) == (7, 9)
    assert of_kind["message"]["last"]["roll"] == pytest.approx(0.9)
    assert of_kind["sender"]["lost"] == 1
    assert (of_kind["skipped"]["reason"], of_kind["skipped"]["bytes"]) == ("noise", 5)
    assert of_kind["dli_message"]["count"] == 1
    assert of_kind["dli_message"]["last"]["number"] == of_kind["dli_message"]["number"]
    assert (of_kind["refused"]["reason"], of_kind["refused"]["count"]) == ("bad checksum", 1)


def test_messages_are_printed_as_they_come(listeners: Any, ponte: Path, repository: Path, tmp_path: Path) -> None:
    listener = listeners("--messages")
    link = dialect.MAVLink(None, srcSystem=7, srcComponent=1)
    listener.say(attitude(link, 0.25))
    listener.say(dli_message(ponte, repository, tmp_path))
    first, second = listener.lines()
    assert (first["name"], first["fields"]["roll"]) == ("ATTITUDE", 0.25)
    assert second["edition"] == "3"


def test_silence_is_said(ponte: Path) -> None:
    result = subprocess.run(
        [ponte, "inspect", "udpin://127.0.0.1:0", "--seconds", "0.2"], capture_output=True, text=True, check=True
    )
    assert result.stdout == "nothing was heard on udpin://127.0.0.1:0\n"


def test_a_wrong_endpoint_is_refused_with_the_grammar(ponte: Path) -> None:
    result = subprocess.run([ponte, "inspect", "udpin://127.0.0.1:70000"], capture_output=True, text=True, check=False)
    assert result.returncode == 2
    assert '"70000" at character 19: expected a port' in result.stderr
    assert "tcpout://HOST:PORT" in result.stderr
