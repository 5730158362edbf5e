"""What others build with: the installed package, and the examples, which are a project of their own."""

from __future__ import annotations

import gzip
import json
import socket
import time
from collections.abc import Callable
from pathlib import Path

import pytest
import mavlink_v09 as v09
from programs import HANG_LIMIT_S, REPOSITORY, cached, run
from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega

EPOCH_2015_S = 1_420_070_400
RETURN = 3  # of MAV_ACTION
EXAMPLES = REPOSITORY / "examples"
RECORDING = REPOSITORY / "tests" / "recordings" / "px4_mission_v2_trimmed.tlog.gz"


@pytest.fixture(scope="module")
def codegen(probe: Callable[[str], Path]) -> Path:
    return probe("ponte_codegen")


@pytest.fixture(scope="module")
def prefix(codegen: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the components are installed, alone."""
    folder = tmp_path_factory.mktemp("prefix")
    for component in ("mavlink", "reflection", "autopilot"):
        done = run(["cmake", "--install", codegen.parents[1], "--prefix", folder, "--component", component])
        assert done.returncode == 0, done.stderr
    return folder


def configure(codegen: Path, prefix: Path, source: Path, build: Path) -> str:
    """What CMake says on stderr, with the compiler and the sanitizers of the build that made the libraries."""
    sanitize = cached(codegen, "PONTE_SANITIZE")
    done = run(
        ["cmake", "-G", "Ninja", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}",
         f"-DCMAKE_CXX_COMPILER={cached(codegen, 'CMAKE_CXX_COMPILER')}",
         f"-DCMAKE_CXX_FLAGS={f'-fsanitize={sanitize}' if sanitize else ''}"]
    )  # fmt: skip
    return done.stderr if done.returncode else ""


@pytest.fixture(scope="module")
def example(codegen: Path, prefix: Path, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """The examples, built against the installed package; gives the path of one."""
    build = tmp_path_factory.mktemp("examples")
    assert configure(codegen, prefix, EXAMPLES, build) == ""
    built = run(["cmake", "--build", build])
    assert built.returncode == 0, built.stdout
    return lambda name: build / name


def own_link() -> ardupilotmega.MAVLink:
    return ardupilotmega.MAVLink(None, srcSystem=7, srcComponent=1)


def test_a_component_that_does_not_exist_is_named(codegen: Path, prefix: Path, tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(x CXX)\nfind_package(ponte REQUIRED COMPONENTS mavlink engine)\n"
    )
    assert "engine" in configure(codegen, prefix, tmp_path, tmp_path / "build")


def test_nothing_installed_points_back_to_the_sources(prefix: Path) -> None:
    cmake_files = list((prefix / "lib" / "cmake" / "ponte").iterdir())
    assert len(cmake_files) >= 7
    assert [path for path in cmake_files if str(REPOSITORY) in path.read_text()] == []


def test_read_tlog_counts_what_pymavlink_counts(example: Callable[[str], Path], tmp_path: Path) -> None:
    tlog = tmp_path / "flight.tlog"
    tlog.write_bytes(gzip.decompress(RECORDING.read_bytes()))
    done = run([example("read_tlog"), tlog])
    counts = {name: int(count) for count, name in (line.split() for line in done.stdout.splitlines() if line[0] == " ")}
    peer: dict[str, int] = {}
    log = mavutil.mavlink_connection(str(tlog), dialect="ardupilotmega")
    while (message := log.recv_match()) is not None:
        peer[message.get_type()] = peer.get(message.get_type(), 0) + 1
    assert {name: counts.get(name) for name in peer if not name.startswith("UNKNOWN")} == {
        name: count for name, count in peer.items() if not name.startswith("UNKNOWN")
    }


def test_send_heartbeat_is_heard_by_pymavlink(example: Callable[[str], Path]) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as station:
        station.bind(("127.0.0.1", 0))
        station.settimeout(HANG_LIMIT_S)
        done = run([example("send_heartbeat"), str(station.getsockname()[1])])
        (message,) = own_link().parse_buffer(station.recv(2048))
    assert done.returncode == 0
    assert (message.get_type(), message.type, message.system_status) == ("HEARTBEAT", 18, 4)
    assert (message.get_srcSystem(), message.get_srcComponent()) == (1, 191)


def test_on_message_tells_what_pymavlink_sent(example: Callable[[str], Path], tmp_path: Path) -> None:
    link = own_link()
    sent = [
        ardupilotmega.MAVLink_attitude_message(1, 0.25, 0, 0, 0, 0, 0),
        ardupilotmega.MAVLink_statustext_message(6, b"Init Gyro"),
    ]
    stream = tmp_path / "stream"
    stream.write_bytes(b"noise" + b"".join(bytes(message.pack(link)) for message in sent))
    done = run(["sh", "-c", f"{example('on_message')} < {stream}"])
    assert done.stdout.splitlines() == ["system 7 rolls 0.250 rad", 'says "Init Gyro"', "2 frames"]


def test_mavlink_09_sends_a_vehicle_home(example: Callable[[str], Path], tmp_path: Path) -> None:
    stream = tmp_path / "stream"
    stream.write_bytes(b"".join(v09.pack("ATTITUDE", 0, roll, 0, 0, 0, 0, 0, system=4) for roll in (0.5, -1.5)))
    done = run(["sh", "-c", f"{example('mavlink_09')} < {stream}"])
    home = v09.pack("ACTION", 4, 1, RETURN, system=255, component=190)
    assert done.stdout == home.hex() + "\n"


def test_signed_link_and_pymavlink_judge_each_other(example: Callable[[str], Path], tmp_path: Path) -> None:
    key = bytes(range(32))
    (tmp_path / "key").write_text(key.hex())
    heartbeat = ardupilotmega.MAVLink_heartbeat_message(2, 3, 81, 4, 4, 3)
    link = own_link()
    link.signing.secret_key, link.signing.sign_outgoing = key, True
    link.signing.timestamp = int((time.time() - EPOCH_2015_S) * 1e5)
    signed = bytes(heartbeat.pack(link))
    stranger = signed[:-1] + bytes((signed[-1] ^ 1,))
    (tmp_path / "stream").write_bytes(signed + signed + stranger + bytes(heartbeat.pack(own_link())))
    done = run(["sh", "-c", f"{example('signed_link')} {tmp_path}/key < {tmp_path}/stream"])
    *verdicts, own = done.stdout.splitlines()
    assert verdicts == ["taken", "replayed", "wrong signature", "unsigned"]
    judge = own_link()
    judge.signing.secret_key = key
    (message,) = judge.parse_buffer(bytes.fromhex(own))
    assert (message.get_type(), message.get_srcSystem()) == ("HEARTBEAT", 255)


def test_json_both_ways(example: Callable[[str], Path]) -> None:
    fields = {"type": "MAV_TYPE_QUADROTOR", "autopilot": 3, "base_mode": "MAV_MODE_FLAG_SAFETY_ARMED|1", "custom_mode": 4,
              "system_status": 4, "mavlink_version": 3}  # fmt: skip
    lines = [json.dumps({"name": "HEARTBEAT", "fields": fields}), json.dumps({"name": "HEARTBEAT", "fields": {"type": 300}})]
    hexed, again, refused = run([example("json_both_ways")], "\n".join(lines) + "\n").stdout.splitlines()
    (message,) = own_link().parse_buffer(bytes.fromhex(hexed))
    assert (message.type, message.base_mode, message.custom_mode) == (2, 129, 4)
    told = json.loads(again)
    assert (told["fields"]["base_mode"], told["labels"]["type"]) == (129, "MAV_TYPE_QUADROTOR")
    assert refused == "refused: fields.type: it is 300; expected an integer from 0 to 255, or a name of MAV_TYPE"


def test_own_dialect(example: Callable[[str], Path]) -> None:
    done = run([example("own_dialect")])
    assert done.returncode == 0
    assert done.stdout.splitlines()[1:] == ["state = 1 ", "temperature = 41.5 degC"]


def test_describe_message(example: Callable[[str], Path], prefix: Path) -> None:
    program = example("describe_message")
    known = run([program, EXAMPLES / "lamps.xml", "LAMP", prefix / "share" / "ponte" / "mavlink"])
    assert known.stdout.splitlines() == [
        "LAMP, id 60001, 5 bytes", "  state [] LAMP_STATE_OFF LAMP_STATE_ON", "  temperature [degC]",
    ]  # fmt: skip
    lost = run([program, EXAMPLES / "lamps.xml", "LAMP"])
    assert (lost.returncode, lost.stdout) == (1, f"{EXAMPLES}/lamps.xml:3: included file 'minimal.xml' was not found\n")


@pytest.mark.parametrize("autopilot", ["ardupilot", "px4"])
def test_services_lead_a_vehicle(example: Callable[[str], Path], start_ponte: Callable[..., None], autopilot: str) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        port = str(probe.getsockname()[1])
    start_ponte("sim", "--autopilot", autopilot, "--endpoint", f"udpout://127.0.0.1:{port}", "--speedup", "10", "--quiet")
    home_items = 1 if autopilot == "ardupilot" else 0
    assert run([example("upload_mission"), port, "12"]).stdout == f"{12 + 1 + home_items} items on board\n"
    name = "RTL_ALT" if autopilot == "ardupilot" else "RTL_RETURN_ALT"
    assert run([example("set_parameter"), port, name, "20"]).stdout == f"{name} is 20\n"
    assert run([example("take_off"), port, "15"]).stdout == "in the air\non its way home\n"
    set_home, unknown = "179", "31000"
    assert run([example("any_command"), port, set_home, "1"]).stdout == "accepted after 1 messages\n"
    refused = run([example("any_command"), port, unknown])
    assert (refused.returncode, refused.stderr) == (1, "not accepted\n")
