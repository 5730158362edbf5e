"""`ponte route` between sockets of ours, pymavlink and MAVProxy: who gets what, byte for byte, whoever else is slow."""

from __future__ import annotations

import json
import os
import socket
import struct
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as dialect

import mavlink_frames
import tlog
from programs import HANG_LIMIT_S, run

SETUP_SIGNING = 256


def free_port(kind: socket.SocketKind) -> int:
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def talker(system: int, component: int = 1) -> dialect.MAVLink:
    return dialect.MAVLink(None, srcSystem=system, srcComponent=component)


def heartbeat(link: dialect.MAVLink) -> bytes:
    return bytes(dialect.MAVLink_heartbeat_message(2, 3, 81, 0, 3, 3).pack(link))


class UdpPeer:
    """A peer of an endpoint that listens."""

    def __init__(self, port: int) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.settimeout(HANG_LIMIT_S)
        self.socket.connect(("127.0.0.1", port))

    def say(self, frame: bytes) -> None:
        self.socket.send(frame)

    def hear(self) -> bytes:
        return self.socket.recv(2048)

    def hear_until(self, frame: bytes) -> None:
        while self.hear() != frame:
            pass


class Route:
    """A router with UDP ports, and perhaps one for TCP at the end."""

    def __init__(self, ponte: Path, udp: int, *options: str, untrusted: bool = False, tcp: bool = False) -> None:
        self.ports = [free_port(socket.SOCK_DGRAM) for _ in range(udp)]
        self.endpoints = [f"udpin://127.0.0.1:{port}" for port in self.ports]
        if tcp:
            self.ports.append(free_port(socket.SOCK_STREAM))
            self.endpoints.append(f"tcpin://127.0.0.1:{self.ports[-1]}")
        places = [*self.endpoints[:-1], "--untrusted", self.endpoints[-1]] if untrusted else self.endpoints
        options = tuple(option.format(*self.endpoints) for option in options)
        command = [str(ponte), "route", *places, "--json", "--every", "3600", *options]
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        assert self.process.stderr is not None
        for _ in self.endpoints:
            assert self.process.stderr.readline().rstrip().endswith("is up")

    def join(self, *systems: int) -> list[UdpPeer]:
        """A peer on each UDP port, whose system the router then knows."""
        peers = [UdpPeer(port) for port, _ in zip(self.ports, systems, strict=False)]
        assert self.process.stderr is not None
        for peer, system in zip(peers, systems, strict=True):
            peer.say(heartbeat(talker(system)))
        for _ in peers:
            assert " joined " in self.process.stderr.readline()
        # The second is heard by all, and is the last that waits for them.
        for peer, system in zip(peers, systems, strict=True):
            link = talker(system)
            link.seq = 1
            frame = heartbeat(link)
            peer.say(frame)
            for other in peers:
                if other is not peer:
                    other.hear_until(frame)
        return peers

    def command(self, line: str) -> dict[str, Any]:
        """What it answers to a line."""
        assert self.process.stdin is not None and self.process.stdout is not None
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        answer: dict[str, Any] = json.loads(self.process.stdout.readline())
        assert (answer.pop("kind"), answer.pop("command")) == ("answer", line)
        return answer

    def end(self) -> list[dict[str, Any]]:
        self.process.terminate()
        out, _ = self.process.communicate(timeout=HANG_LIMIT_S)
        assert self.process.returncode == 0
        return [json.loads(line) for line in out.splitlines()]


@pytest.fixture
def route(ponte: Path) -> Iterator[Callable[..., Route]]:
    running: list[Route] = []

    def start(*arguments: Any, **options: Any) -> Route:
        running.append(Route(ponte, *arguments, **options))
        return running[-1]

    yield start
    for each in running:
        if each.process.poll() is None:
            each.process.kill()
        each.process.wait(HANG_LIMIT_S)


def dropped(statistics: list[dict[str, Any]], kind: str, reason: str) -> int:
    return sum(line["dropped"].get(reason, 0) for line in statistics if line["kind"] == kind)


def test_a_signed_recording_is_passed_on_byte_for_byte_but_for_its_keys(
    route: Callable[..., Route], repository: Path
) -> None:
    router = route(2)
    vehicle, station = router.join(1, 255)
    passed = keys = 0
    for record in tlog.read_records(repository / "tests" / "recordings" / "ap_signing_v2_trimmed.tlog.gz"):
        frame = mavlink_frames.parse(record.frame)
        sender, receiver = (vehicle, station) if frame.system == 1 else (station, vehicle)
        sender.say(record.frame)
        if frame.message_id == SETUP_SIGNING:
            keys += 1  # had it been passed on, the next frame would not be the one that is heard
            continue
        assert receiver.hear() == record.frame
        passed += 1
    assert keys == 3 and passed > 400
    assert dropped(router.end(), "link", "setup signing") == keys


def test_what_is_for_one_goes_there_alone_and_unknown_messages_to_all(route: Callable[..., Route]) -> None:
    router = route(3)
    one, two, station = router.join(1, 2, 255)
    link = talker(255, 190)
    for target, receiver in ((2, two), (1, one), (2, two)):
        frame = bytes(dialect.MAVLink_param_request_list_message(target, 1).pack(link))
        station.say(frame)
        assert receiver.hear() == frame
    unknown = bytes.fromhex("fd03000000ffbe5634120102030000")
    for _ in range(2):
        station.say(unknown)
        assert one.hear() == unknown and two.hear() == unknown
    # One request and one unknown message came again: they are counted, as they may tell of a loop.
    links = [line for line in router.end() if line["kind"] == "link"]
    assert {(*line["systems"], line["repeated"]) for line in links} == {(1, 0), (2, 0), (255, 2)}


def test_nothing_risky_crosses_an_untrusted_endpoint(route: Callable[..., Route]) -> None:
    router = route(3, untrusted=True)
    vehicle, station, stranger = router.join(1, 255, 254)
    link = talker(254, 190)
    reboot = dialect.MAVLink_command_long_message(1, 1, 246, 0, 1, 0, 0, 0, 0, 0, 0)
    harmless = dialect.MAVLink_command_long_message(1, 1, 400, 0, 0, 0, 0, 0, 0, 0, 0)
    shell = dialect.MAVLink_serial_control_message(10, 0, 0, 0, 1, [104] + [0] * 69)
    files = dialect.MAVLink_file_transfer_protocol_message(0, 1, 1, [1] * 251)
    for message in (reboot, shell, files):
        stranger.say(bytes(message.pack(link)))
        frame = bytes(message.pack(talker(255, 190)))
        station.say(frame)
        assert vehicle.hear() == frame
    frame = bytes(harmless.pack(link))
    stranger.say(frame)
    assert vehicle.hear() == frame
    # The shell and the files were for everybody, or not for the stranger: one of them would have gone there.
    assert dropped(router.end(), "link", "untrusted") == 4


def test_a_limit_holds_for_its_endpoint_alone(route: Callable[..., Route]) -> None:
    router = route(3, "--limit", "{1}=ATTITUDE:0")
    vehicle, limited, free = router.join(1, 254, 255)
    link = talker(1)
    for _ in range(5):
        frame = bytes(dialect.MAVLink_attitude_message(0, 0, 0, 0, 0, 0, 0).pack(link))
        vehicle.say(frame)
        assert free.hear() == frame
    last = heartbeat(link)
    vehicle.say(last)
    assert limited.hear() == last
    assert dropped(router.end(), "link", "rate limit") == 5


def test_stalled_and_killed_peers_keep_nobody_waiting(route: Callable[..., Route]) -> None:
    router = route(2, tcp=True)
    vehicle, station = router.join(1, 255)
    stalled, killed = (socket.socket(socket.AF_INET, socket.SOCK_STREAM) for _ in range(2))
    for peer in (stalled, killed):
        peer.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        peer.connect(("127.0.0.1", router.ports[-1]))
        first = b""
        link = talker(1)
        while len(first) < 12:  # it is there when it hears something
            vehicle.say(heartbeat(link))
            station.hear()
            peer.settimeout(0.1)
            try:
                first += peer.recv(12 - len(first))
            except TimeoutError:
                pass
    link = talker(1)
    for number in range(20_000):
        frame = bytes(dialect.MAVLink_statustext_message(6, struct.pack("50s", str(number).encode())).pack(link))
        vehicle.say(frame)
        while station.hear() != frame:  # heartbeats from before
            assert number == 0
        if number == 1000:
            killed.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            killed.close()
    statistics = router.end()
    assert dropped(statistics, "endpoint", "queue_full") > 0
    assert sum(line["kind"] == "link" for line in statistics) == 3
    stalled.close()


def test_endpoints_come_and_go_while_others_lose_nothing(route: Callable[..., Route]) -> None:
    router = route(2, "--commands")
    vehicle, station = router.join(1, 255)
    link = talker(1)
    link.seq = 2

    def fly() -> None:
        """Ten frames each way, of which none may be missing."""
        for _ in range(10):
            frame = bytes(dialect.MAVLink_attitude_message(0, 0.5, 0, 0, 0, 0, 0).pack(link))
            vehicle.say(frame)
            link.seq = (link.seq + 1) % 256
            assert station.hear() == frame
            asked = bytes(dialect.MAVLink_param_request_list_message(1, 1).pack(talker(255, link.seq)))
            station.say(asked)
            assert vehicle.hear() == asked

    for turn in range(5):
        endpoint = f"tcpin://127.0.0.1:{free_port(socket.SOCK_STREAM)}"
        number = 3 + turn
        assert router.command(f"add {endpoint}") == {"number": number, "endpoint": endpoint}
        fly()
        late = mavutil.mavlink_connection(endpoint.replace("in://", ":"), dialect="ardupilotmega")
        heard = None
        while heard is None:  # until the router knows it
            fly()
            heard = late.recv_match(type="ATTITUDE", blocking=True, timeout=0.1)
        assert heard.roll == 0.5
        fly()
        which = str(number) if turn % 2 else endpoint
        assert router.command(f"remove {which}") == {"number": number, "endpoint": endpoint}
        late.port.settimeout(HANG_LIMIT_S)
        while late.port.recv(4096):
            pass  # and it is closed
        late.close()
        fly()
    listed = router.command("list")["endpoints"]
    assert [(each["number"], each["endpoint"], each["links"]) for each in listed] == [
        (index + 1, endpoint, 1) for index, endpoint in enumerate(router.endpoints)
    ]
    assert dropped(router.end(), "endpoint", "queue_full") == 0


def test_an_endpoint_is_added_with_rules(route: Callable[..., Route]) -> None:
    router = route(1, "--commands", tcp=True)
    ports = [free_port(socket.SOCK_DGRAM) for _ in range(2)]
    for port, rules in zip(ports, ("untrusted", "ATTITUDE:0 HEARTBEAT:1e6"), strict=True):
        assert "error" not in router.command(f"add udpin://127.0.0.1:{port} {rules}")
    assert [each["untrusted"] for each in router.command("list")["endpoints"]] == [False, False, True, False]
    vehicle, stranger, limited = UdpPeer(router.ports[0]), UdpPeer(ports[0]), UdpPeer(ports[1])
    peers = (vehicle, stranger, limited)
    for system, peer in enumerate(peers, 1):
        peer.say(heartbeat(talker(system)))
        while sum(each["links"] for each in router.command("list")["endpoints"]) < system:
            pass
    link = talker(1)
    link.seq = 10
    attitude, last = (bytes(message.pack(link)) for message in (
        dialect.MAVLink_attitude_message(0, 0, 0, 0, 0, 0, 0), dialect.MAVLink_heartbeat_message(2, 3, 81, 0, 4, 3)))  # fmt: skip
    shell = bytes(dialect.MAVLink_serial_control_message(10, 0, 0, 0, 1, [104] + [0] * 69).pack(link))
    for frame in (shell, attitude, last):
        vehicle.say(frame)
    heard = {peer: list(iter(peer.hear, last)) for peer in (stranger, limited)}
    assert attitude in heard[stranger] and shell not in heard[stranger]
    assert shell in heard[limited] and attitude not in heard[limited]


def test_bad_commands_are_answered_and_change_nothing(route: Callable[..., Route]) -> None:
    router = route(2, "--commands")
    before = router.command("list")
    for line, reason in (
        ("add", "expected add ENDPOINT"),
        ("add nowhere", "expected serial://"),
        (f"add {router.endpoints[0]}", "Address already in use"),
        ("add udpin://127.0.0.1:0 trusted", "expected untrusted, or MESSAGE:HZ"),
        ("remove 3", "there is no endpoint 3"),
        ("remove udpin://127.0.0.1:1", "is not routed"),
        ("list all", "expected add ENDPOINT"),
    ):
        assert reason in router.command(line)["error"], line
    assert router.command("list") == before
    assert router.process.stdin is not None
    router.process.stdin.close()
    router.process.stdin = None
    assert router.process.stderr is not None
    assert "commands are over" in router.process.stderr.readline()
    router.join(1, 255)  # routing is not


def test_commands_are_answered_in_words_without_json(ponte: Path) -> None:
    process = subprocess.Popen(
        [str(ponte), "route", "--commands", "--quiet"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    assert process.stdin is not None and process.stdout is not None
    endpoint = f"udpin://127.0.0.1:{free_port(socket.SOCK_DGRAM)}"
    for line, answer in (
        (f"# nothing\n\nadd {endpoint} untrusted", f"added 1 {endpoint}"),
        ("list", f"1 {endpoint} untrusted up, 0 links"),
        ("remove 1", f"removed 1 {endpoint}"),
        ("list", "no endpoints"),
        ("remove 1", "error: there is no endpoint 1"),
    ):
        process.stdin.write(line + "\n")
        process.stdin.flush()
        assert process.stdout.readline() == answer + "\n"
    process.terminate()
    process.communicate(timeout=HANG_LIMIT_S)
    assert process.returncode == 0


def test_mavproxy_and_pymavlink_are_connected_at_once(
    route: Callable[..., Route], ponte: Path, tmp_path: Path
) -> None:
    router = route(2, tcp=True)
    listener = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    listener.bind(("127.0.0.1", 0))
    listener.settimeout(HANG_LIMIT_S)
    programs = [
        [ponte, "sim", "--endpoint", f"udpout://127.0.0.1:{router.ports[0]}", "--quiet"],
        [
            sys.executable, Path(sys.executable).with_name("mavproxy.py"), "--daemon", "--nowait",
            f"--master=tcp:127.0.0.1:{router.ports[2]}", f"--out=udp:127.0.0.1:{listener.getsockname()[1]}",
        ],
    ]  # fmt: skip
    running = [
        subprocess.Popen(
            [str(part) for part in command], cwd=tmp_path, env={**os.environ, "HOME": str(tmp_path)},
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )
        for command in programs
    ]  # fmt: skip
    try:
        station = mavutil.mavlink_connection(f"udpout:127.0.0.1:{router.ports[1]}", source_system=254, dialect="ardupilotmega")
        heard: set[tuple[int, int]] = set()
        while not {(1, 1), (255, 230)} <= heard:  # the vehicle, and MAVProxy
            station.mav.heartbeat_send(6, 8, 0, 0, 4)
            message = station.recv_match(type="HEARTBEAT", blocking=True, timeout=1)
            if message is not None:
                heard.add((message.get_srcSystem(), message.get_srcComponent()))
        station.mav.timesync_send(0, 4321)
        while station.recv_match(type="TIMESYNC", blocking=True, timeout=HANG_LIMIT_S).ts1 != 4321:
            pass
        judge = dialect.MAVLink(None)
        through_mavproxy: set[int] = set()
        while not {1, 254} <= through_mavproxy:
            station.mav.heartbeat_send(6, 8, 0, 0, 4)
            for message in judge.parse_buffer(listener.recv(2048)) or []:
                through_mavproxy.add(message.get_srcSystem())
    finally:
        for process in running:
            process.kill()
            process.wait(HANG_LIMIT_S)
    assert {tuple(line["systems"]) for line in router.end() if line["kind"] == "link"} >= {(1,), (254,)}


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (["udpin://127.0.0.1:0"], "two endpoints"),
        (["udpin://127.0.0.1:0", "udpin://127.0.0.1:0", "--limit", "udpin://127.0.0.1:0=NOTHING:4"], "ENDPOINT=MESSAGE:HZ"),
        (["udpin://127.0.0.1:0", "udpin://127.0.0.1:0", "--limit", "tcpin://127.0.0.1:0=ATTITUDE:4"], "no such endpoint"),
        (["udpin://127.0.0.1:0", "nowhere"], "ENDPOINT"),
    ],
)  # fmt: skip
def test_bad_usage_is_refused(ponte: Path, options: list[str], reason: str) -> None:
    done = run([ponte, "route", *options])
    assert done.returncode == 2
    assert reason in done.stderr
