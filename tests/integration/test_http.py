"""The bridge page's server, asked as a browser asks it. Every answer and every message is checked against web/contract.

pymavlink is the vehicle, and the independent reader judges what crosses the bridge."""

from __future__ import annotations

import os
import re
import shutil
import socket
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as dialect
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from dli_reader import decode_datagram
from vsm_bench import DliReceiver, Udp, Vehicle
from web_client import PATIENCE_S, Server, Stream

COMMAND, WATCH = "a-token-to-command", "a-token-to-watch"
TOKENS = {"PONTE_HTTP_COMMAND_TOKEN": COMMAND, "PONTE_HTTP_WATCH_TOKEN": WATCH}
VEHICLE_ID = "14:40:00:01"


@pytest.fixture
def server(ponte: Path) -> Iterator[Server]:
    with Server(ponte, "--every-sample") as running:
        yield running


class Flight:
    """A vehicle on a link of the server, which has heard it."""

    def __init__(self, server: Server, stream: Stream) -> None:
        self.carrier = Udp()
        self.vehicle = Vehicle(self.carrier, dialect, DliReceiver())
        answer = server.ask("POST", "/api/v1/vehicle-links", {"endpoint": self.carrier.endpoint})
        assert answer.status == 201 and answer.json["endpoint"] == self.carrier.endpoint
        self.link: int = answer.json["number"]
        self.vehicle.say("heartbeat", 2, 3, 81, 0, 3, 3)
        while not any(found["id"] == VEHICLE_ID for found in stream.next("status")["vehicles"]):
            self.vehicle.say("heartbeat", 2, 3, 81, 0, 3, 3)

    def attitude(self, number: int) -> None:
        self.vehicle.say("attitude", number * 100, 0.1 + number / 1000, -0.2, 0.3, 0.01, 0.02, 0.03)


def wait_for(stream: Stream, kind: str, wanted: Any) -> Any:
    """The first message of this kind that is wanted."""
    while not wanted(message := stream.next(kind)):
        pass
    return message


def crossing_of(stream: Stream, name: str, wanted: Any = lambda _: True) -> Any:
    """The next crossing of a message of this name that is wanted."""
    while True:
        for crossing in stream.next("crossings")["crossings"]:
            if crossing.get("mavlink", {}).get("name") == name and wanted(crossing):
                return crossing


def test_answers_follow_the_contract(server: Server) -> None:
    for target in ("/healthz", "/metrics", "/api/v1/status", "/api/v1/ports", "/api/v1/catalogue"):
        answer = server.ask("GET", target)
        assert answer.status == 200, target
        assert answer.headers["x-content-type-options"] == "nosniff"
        assert answer.headers["referrer-policy"] == "no-referrer"
        policy = answer.headers["content-security-policy"]
        assert "frame-ancestors 'none'" in policy and "unsafe" not in policy
    assert server.ask("GET", "/api/v1/latency-study/result").status == 404
    assert server.ask("DELETE", "/api/v1/latency-study").status == 204
    assert server.ask("DELETE", "/api/v1/vehicle-links/1").status == 404
    assert server.ask("PUT", "/api/v1/conversion", {"on": "yes"}).status == 400
    assert server.ask("POST", "/api/v1/vehicle-links", {"endpoint": "serial:///dev/ttyX:fast"}).status == 400
    refused = server.ask("POST", "/api/v1/vehicle-links", {"endpoint": "file:///etc/passwd"})
    assert refused.status == 400 and refused.json["code"] == "bad_endpoint"


def test_the_catalogue_is_sent_once_and_knows_the_rules(server: Server) -> None:
    plain = server.ask("GET", "/api/v1/catalogue")
    zipped = server.ask("GET", "/api/v1/catalogue", headers={"Accept-Encoding": "gzip, br"})
    assert zipped.headers["content-encoding"] == "gzip"
    assert len(zipped.body) < len(plain.body) and zipped.content == plain.body
    again = server.ask("GET", "/api/v1/catalogue", headers={"If-None-Match": plain.headers["etag"]})
    assert again.status == 304 and again.body == b""
    catalogue = plain.json
    attitude = next(message for message in catalogue["mavlink"]["messages"] if message["name"] == "ATTITUDE")
    assert {field["name"]: field["offset"] for field in attitude["fields"]} == {
        "time_boot_ms": 0, "roll": 4, "pitch": 8, "yaw": 12, "rollspeed": 16, "pitchspeed": 20, "yawspeed": 24}
    facts = {rule["fact"] for rule in catalogue["rules"]["from_mavlink"] if "roll" in rule["sources"]}
    fields = {rule["field"] for rule in catalogue["rules"]["to_dli"] if rule["number"] == 4000 and facts & set(rule["facts"])}
    assert "roll" in fields


def test_numbers_on_the_page_are_those_on_the_wire(server: Server) -> None:
    with server.stream() as stream:
        assert stream.next()["kind"] == "hello"
        flight = Flight(server, stream)
        stream.watch(VEHICLE_ID, traffic=True)
        for number in range(20):
            flight.attitude(number)
            crossing = crossing_of(stream, "ATTITUDE", lambda c: c["mavlink"]["fields"]["time_boot_ms"] == number * 100)
            frame = crossing["mavlink"]
            heard = dialect.MAVLink(None).parse_buffer(bytes.fromhex(frame["hex"]))[0].to_dict()
            for name, value in frame["fields"].items():
                assert value == pytest.approx(heard[name], rel=1e-7), name
            told = [message for message in crossing["dli"] if message["number"] == 4000]
            assert len(told) == 1
            read = decode_datagram(bytes.fromhex(told[0]["hex"]), "3")[0]
            assert {field.raw for field in read.fields.values()} == {f["raw"] for f in told[0]["fields"].values()}
            stages = crossing["stages_ns"]
            assert 0 <= stages["decoded"] <= stages["translated"] <= stages["sent"]
        traffic = wait_for(stream, "traffic", lambda t: any(r["last"]["name"] == "ATTITUDE" for r in t["mavlink"]))
        assert traffic["senders"][0]["lost"] == 0
        assert wait_for(stream, "timing", lambda t: t["total"]["count"] >= 20)["total"]["max_ns"] > 0
        assert b'ponte_messages_total{side="dli"}' in server.ask("GET", "/metrics").body


def test_conversion_is_switched_and_links_are_closed(server: Server) -> None:
    with server.stream() as stream:
        flight = Flight(server, stream)
        stream.watch(VEHICLE_ID)
        assert server.ask("PUT", "/api/v1/conversion", {"on": False}).status == 204
        wait_for(stream, "status", lambda s: not s["conversion"])
        flight.attitude(1)
        assert crossing_of(stream, "ATTITUDE")["dli"] == []
        assert server.ask("PUT", "/api/v1/conversion", {"on": True}).status == 204
        wait_for(stream, "status", lambda s: s["conversion"])
        flight.attitude(2)
        assert crossing_of(stream, "ATTITUDE", lambda c: c["mavlink"]["fields"]["time_boot_ms"] == 200)["dli"]
        assert server.ask("DELETE", f"/api/v1/vehicle-links/{flight.link}").status == 204
        wait_for(stream, "status", lambda s: not s["vehicle_links"])
    with server.stream() as late:
        events = late.next("events")["events"]
        assert [event["number"] for event in events] == list(range(1, len(events) + 1))
        codes = [event["code"] for event in events]
        for code in ("link_up", "vehicle_found", "conversion_off", "conversion_on", "vehicle_lost", "link_down"):
            assert code in codes, codes


def test_the_latency_study_runs_from_the_page(server: Server) -> None:
    with server.stream() as stream:
        assert stream.next("study")["state"] == "none"
        flight = Flight(server, stream)
        assert server.ask("POST", "/api/v1/latency-study", {"samples": 5, "limit_ms": 60000}).status == 202
        assert server.ask("POST", "/api/v1/latency-study", {"samples": 5, "limit_ms": 60000}).status == 409
        number, study, events = 0, {"state": "running"}, set()
        while study["state"] == "running" or "study_done" not in events:
            message = stream.next("study", "events")
            if message["kind"] == "events":
                events |= {event["code"] for event in message["events"]}
                continue
            study = message
            if study["state"] == "running":
                assert study["done"] == number
                number += 1
                flight.attitude(number)
        assert study["state"] == "done" and number == 5
    result = server.ask("GET", "/api/v1/latency-study/result").json
    assert len(result["samples"]) == 5 and result["pass"]
    rows = server.ask("GET", "/api/v1/latency-study/result?format=csv").body.decode().splitlines()
    assert len(rows) == 6
    page = server.ask("GET", "/api/v1/latency-study/result?format=html")
    assert page.headers["content-disposition"].startswith("attachment") and b"<svg" in page.body


def test_a_token_opens_what_its_role_may(ponte: Path) -> None:
    with Server(ponte, environment=TOKENS) as server:
        assert server.token is None, "a token that was given is not printed"
        assert server.ask("GET", "/api/v1/status").json["code"] == "no_session"
        with pytest.raises(InvalidStatus) as refused:
            server.stream()
        assert refused.value.response.status_code == 401
        assert server.sign_in("not a token of ours").json["code"] == "wrong_token"
        answer = server.sign_in(WATCH)
        assert answer.json == {"role": "watch"}
        assert re.fullmatch(r"ponte_session=[0-9a-f]{32}; HttpOnly; SameSite=Strict; Path=/", answer.headers["set-cookie"])
        with server.stream() as stream:
            assert stream.next("hello")["role"] == "watch"
        for method, target, body in (
            ("PUT", "/api/v1/conversion", {"on": False}),
            ("POST", "/api/v1/vehicle-links", {"endpoint": "udpin://127.0.0.1:0"}),
            ("DELETE", "/api/v1/vehicle-links/1", None),
            ("POST", "/api/v1/latency-study", {"samples": 5, "limit_ms": 1}),
        ):
            assert server.ask(method, target, body).json["code"] == "watch_only"
        assert server.ask("GET", "/api/v1/status").json["conversion"] is True
        assert server.ask("DELETE", "/api/v1/session").status == 204
        assert server.ask("GET", "/api/v1/status").status == 401, "the session is void"
        assert server.sign_in(COMMAND).json == {"role": "command"}
        assert server.ask("PUT", "/api/v1/conversion", {"on": False}).status == 204


def test_guessing_is_slow(ponte: Path) -> None:
    with Server(ponte, environment=TOKENS) as server:
        codes = [server.sign_in(f"guess number {number:04}").json["code"] for number in range(40)]
        assert set(codes) == {"wrong_token", "too_often"}


def test_other_machines_need_a_token(ponte: Path) -> None:
    with Server(ponte, host="0.0.0.0", quiet=True) as server:
        assert server.token is not None
        assert server.ask("GET", "/api/v1/status").status == 401
        assert server.sign_in(server.token).json == {"role": "command"}
        assert server.ask("GET", "/api/v1/status").status == 200


def test_tokens_in_a_file_are_their_owners_alone(ponte: Path, tmp_path: Path) -> None:
    file = tmp_path / "tokens.toml"
    file.write_text(f'command = "{COMMAND}"\n')
    file.chmod(0o644)
    command = [str(ponte), "vsm", "--http", "127.0.0.1:0", "--http-tokens", str(file)]
    refused = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert refused.returncode == 1 and "chmod 600" in refused.stderr and COMMAND not in refused.stderr
    file.chmod(0o600)
    with Server(ponte, "--http-tokens", str(file)) as server:
        assert server.sign_in(COMMAND).json == {"role": "command"}


def test_foreign_pages_and_names_are_refused(server: Server) -> None:
    for origin in ("http://evil.example", "null", f"https://127.0.0.1:{server.port}"):
        answer = server.ask("PUT", "/api/v1/conversion", {"on": False}, headers={"Origin": origin})
        assert answer.status == 403 and answer.json["code"] == "foreign_origin"
        with pytest.raises(InvalidStatus) as refused:
            server.stream(Origin=origin)
        assert refused.value.response.status_code == 403
    answer = server.ask("GET", "/api/v1/status", headers={"Host": "rebound.example"})
    assert answer.status == 403 and answer.json["code"] == "foreign_host"
    assert server.ask("GET", "/api/v1/status").json["conversion"] is True
    own = {"Origin": f"http://127.0.0.1:{server.port}"}
    assert server.ask("PUT", "/api/v1/conversion", {"on": True}, headers=own).status == 204
    with server.stream(**own) as stream:
        assert stream.next("hello")["role"] == "command"


def test_sizes_are_limited(server: Server) -> None:
    assert server.ask("GET", "/healthz", headers={"X-Long": "x" * 9000}).status == 431
    assert server.ask("PUT", "/api/v1/conversion", b"x" * 5000).status == 413
    for closing_code, messages in ((1009, ["x" * 2000]), (1008, ["{}"] * 30)):
        with server.stream() as stream:
            for message in messages:
                stream.socket.send(message)
            with pytest.raises(ConnectionClosed) as closed:
                while True:
                    stream.next()
            assert closed.value.rcvd is not None and closed.value.rcvd.code == closing_code
    assert server.ask("GET", "/healthz").status == 200


def test_garbage_is_answered_or_cut_off(server: Server) -> None:
    for garbage in (b"\x16\x03\x01\x02\x00\x01", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"\0" * 100,
                    b"PUT / HTTP/1.1\r\nContent-Length: -1\r\n\r\n"):
        with socket.create_connection(("127.0.0.1", server.port), PATIENCE_S) as raw:
            raw.sendall(garbage)
            raw.shutdown(socket.SHUT_WR)
            answer = b"".join(iter(lambda: raw.recv(4096), b""))
        assert answer == b"" or answer.startswith(b"HTTP/1.1 400 "), answer
    assert server.ask("GET", "/healthz").status == 200


def test_connections_are_limited(server: Server) -> None:
    held = [socket.create_connection(("127.0.0.1", server.port), PATIENCE_S) for _ in range(64)]
    assert server.ask("GET", "/healthz").status == 503
    for connection in held:
        connection.close()
    deadline = time.monotonic() + PATIENCE_S
    while server.ask("GET", "/healthz").status != 200:
        assert time.monotonic() < deadline, "the connections that were closed are still counted"


def test_a_slow_client_loses_its_own_telemetry_only(ponte: Path) -> None:
    with Server(ponte) as server, server.stream() as quick:
        flight = Flight(server, quick)
        link = dialect.MAVLink(None, srcSystem=1, srcComponent=1)

        def fill_the_table() -> None:
            """Many rows make long messages."""
            for component in range(2, 252):
                link.srcComponent = component
                for message in (dialect.MAVLink_heartbeat_message(2, 8, 81, 0, 3, 3),
                                dialect.MAVLink_attitude_message(1, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0)):
                    flight.carrier.send(message.pack(link))
            quick.next()

        for _ in range(3):
            fill_the_table()
        slow_socket = socket.socket()
        # The system keeps little for such a connection, so that it is full after one long message. Who reads nothing is
        # cut off after 10 s: on a slow machine that came first when there was more room.
        slow_socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        slow_socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_MAXSEG, 536)
        slow_socket.connect(("127.0.0.1", server.port))
        url = f"ws://127.0.0.1:{server.port}/api/v1/stream"
        opening = connect(url, sock=slow_socket, compression=None, max_size=None, max_queue=1, proxy=None, close_timeout=0)
        with Stream(opening) as slow:
            slow.watch(VEHICLE_ID, traffic=True)
            dropped = 0
            while dropped == 0:  # of the slow one: the other has asked for no telemetry yet
                fill_the_table()
                metrics = server.ask("GET", "/metrics").body.decode()
                dropped = int(re.search(r"^ponte_telemetry_dropped_total (\d+)$", metrics, re.MULTILINE)[1])
            quick.watch(VEHICLE_ID)
            flight.attitude(7)
            assert crossing_of(quick, "ATTITUDE", lambda c: c["mavlink"]["fields"]["time_boot_ms"] == 700)["dli"]
            assert server.ask("PUT", "/api/v1/conversion", {"on": False}).status == 204
            try:
                assert wait_for(slow, "dropped", lambda m: m["count"] > 0)
            except ConnectionClosed:
                pass  # it read nothing for so long that it was cut off, as the contract says
            numbers = [event["number"] for event in quick.next("events")["events"]]
        assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def test_the_server_may_be_restarted(ponte: Path) -> None:
    with Server(ponte) as first:
        port = first.port
        with first.stream() as stream:
            stream.next("status")
    with Server(ponte, port=port) as second:
        assert second.port == port
        with second.stream() as stream:
            assert stream.next("hello")["version"]


def test_a_busy_port_is_told(server: Server, ponte: Path) -> None:
    command = [str(ponte), "vsm", "--http", f"127.0.0.1:{server.port}"]
    refused = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert refused.returncode == 1
    assert f"--http 127.0.0.1:{server.port}: cannot listen there: Address already in use" in refused.stderr


def test_bad_command_lines_are_told(ponte: Path) -> None:
    for options, words in ((["--http", "8586"], "ADDRESS:PORT"), ([], "--vehicle"), (["--web-root", "/tmp"], "--http")):
        refused = subprocess.run([str(ponte), "vsm", *options], capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        assert refused.returncode == 2 and words in refused.stderr, options


def test_files_come_from_the_web_root(ponte: Path, tmp_path: Path) -> None:
    (tmp_path / "assets").mkdir()
    (tmp_path / "index.html").write_text("<!doctype html><title>page</title>")
    (tmp_path / "assets" / "app-12.js").write_text("1")
    with Server(ponte, "--web-root", str(tmp_path)) as server:
        page = server.ask("GET", "/")
        assert page.headers["content-type"] == "text/html; charset=utf-8" and b"page" in page.body
        assert "immutable" in server.ask("GET", "/assets/app-12.js").headers["cache-control"]
        head = server.ask("HEAD", "/")
        assert head.body == b"" and head.headers["content-length"] == str(len(page.body))
        for target in ("/../etc/passwd", "/%2e%2e/secret", "/assets/../../x", "/assets"):
            assert server.ask("GET", target).status == 404


@pytest.fixture(scope="module")
def certificate(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    if shutil.which("openssl") is None:
        pytest.skip("there is no openssl to make a certificate with")
    folder = tmp_path_factory.mktemp("tls")
    key, chain = folder / "key.pem", folder / "chain.pem"
    subprocess.run(
        ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-keyout", key,
         "-out", chain, "-days", "2", "-subj", "/CN=localhost"],
        check=True, capture_output=True, timeout=PATIENCE_S)
    return chain, key


def test_connections_can_be_encrypted(ponte: Path, certificate: tuple[Path, Path]) -> None:
    chain, key = certificate
    with Server(ponte, "--http-cert", str(chain), "--http-key", str(key), environment=TOKENS) as server:
        assert server.scheme == "https"
        assert server.ask("GET", "/healthz").status == 200
        assert "; Secure" in server.sign_in(WATCH).headers["set-cookie"]
        greeting = server.encrypted_greeting()
        assert (greeting["kind"], greeting["role"]) == ("hello", "watch")
        with socket.create_connection(("127.0.0.1", server.port), PATIENCE_S) as plain:
            plain.sendall(b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n")
            assert b"ok" not in plain.recv(4096)


def test_a_key_that_is_none_is_told(ponte: Path, certificate: tuple[Path, Path]) -> None:
    command = [str(ponte), "vsm", "--http", "127.0.0.1:0", "--http-cert", str(certificate[0]), "--http-key", os.devnull]
    refused = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE_S, check=False)
    assert refused.returncode == 1 and "--http-key" in refused.stderr
