"""`ponte vehicle` leads simulated vehicles; pymavlink, on the same vehicle, sees whether it is so."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

os.environ["MAVLINK20"] = "1"
import pytest
from programs import HANG_LIMIT_S, run
from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink

HOME = (-30.06898, -51.12179)
MODES = {"ardupilot": {"guided": 4, "return": 6}, "px4": {"guided": 0x03040000, "return": 0x05040000}}


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


class Witness:
    """A ground station made of pymavlink."""

    def __init__(self, port: int) -> None:
        self.link = mavutil.mavlink_connection(f"udpout:127.0.0.1:{port}", source_system=255, source_component=190)

    def next(self, *names: str, ask: Any = None) -> Any:
        """The next message of one of these types; it says again what it asks for as long as none comes."""
        for _ in range(10 * HANG_LIMIT_S):
            self.link.mav.heartbeat_send(mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, 4)
            if ask is not None:
                self.link.mav.send(ask)
            message = self.link.recv_match(type=list(names), blocking=True, timeout=0.1)
            if message is not None:
                return message
        raise AssertionError(f"no {names} came")

    def forget(self) -> None:
        """What has come so far: the vehicle says everything to everybody."""
        while self.link.recv_match(blocking=False) is not None:
            pass

    def heartbeat(self) -> Any:
        self.forget()
        return self.next("HEARTBEAT")

    def is_armed(self) -> bool:
        return bool(self.heartbeat().base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)

    def parameter(self, name: str) -> Any:
        self.forget()
        while True:
            value = self.next("PARAM_VALUE", ask=mavlink.MAVLink_param_request_read_message(1, 1, name.encode(), -1))
            if value.param_id == name:
                return value

    def mission(self) -> list[Any]:
        self.forget()
        count = self.next("MISSION_COUNT", ask=mavlink.MAVLink_mission_request_list_message(1, 1, 0)).count
        items: list[Any] = []
        while len(items) < count:
            ask = mavlink.MAVLink_mission_request_int_message(1, 1, len(items), 0)
            item = self.next("MISSION_ITEM_INT", ask=ask)
            if item.seq == len(items):
                items.append(item)
        return items


class Vehicle:
    def __init__(self, ponte: Path, port: int, autopilot: str) -> None:
        self.ponte, self.port, self.autopilot = ponte, port, autopilot
        self.witness = Witness(port)

    def tell(self, *arguments: str, status: int = 0) -> Any:
        """What `ponte vehicle` prints, and on stderr."""
        result = run([self.ponte, "vehicle", f"udpout://127.0.0.1:{self.port}", *arguments])
        assert result.returncode == status, result.stderr
        return result

    def tell_json(self, *arguments: str) -> list[dict[str, Any]]:
        return [json.loads(line) for line in self.tell("--json", *arguments).stdout.splitlines()]


@pytest.fixture(params=["ardupilot", "px4"])
def vehicle(request: pytest.FixtureRequest, ponte: Path, start_ponte: Callable[..., None]) -> Iterator[Vehicle]:
    port = free_port()
    # A gimbal, and ten times the patience with setpoints, since its time goes ten times as fast.
    settings = ("MNT_MODE_IN=4", "COM_OF_LOSS_T=10") if request.param == "px4" else ("MNT1_TYPE=1", "GUID_TIMEOUT=30")
    start_ponte(
        "sim", "--autopilot", request.param, "--endpoint", f"udpin://127.0.0.1:{port}", "--speedup", "10",
        "--param", settings[0], "--param", settings[1], "--quiet",
    )  # fmt: skip
    result = Vehicle(ponte, port, request.param)
    ask = mavlink.MAVLink_command_long_message(1, 1, mavlink.MAV_CMD_GET_HOME_POSITION, 0, 0, 0, 0, 0, 0, 0, 0)
    result.witness.next("HOME_POSITION", ask=ask)  # which it knows only with its position
    yield result


def test_flies_up_to_places_and_home(vehicle: Vehicle) -> None:
    assert vehicle.tell_json("takeoff", "20") == [{"vehicle": 1, "action": "takeoff", "result": "done"}]
    assert vehicle.witness.is_armed()
    modes = MODES[vehicle.autopilot]
    vehicle.tell("goto", f"{HOME[0] + 0.001},{HOME[1]},30")
    assert vehicle.witness.heartbeat().custom_mode == modes["guided"]
    vehicle.tell("altitude", "40")
    vehicle.tell("heading", "90")
    vehicle.tell("speed", "4")
    vehicle.tell("gimbal", "point", "-30")
    assert vehicle.tell("velocity", "1,0,0", "2").stdout == "velocity: done\n"
    (status,) = vehicle.tell_json("status")
    assert status["latitude"] == pytest.approx(-0.5248, abs=1e-3)
    vehicle.tell("return")
    assert vehicle.witness.heartbeat().custom_mode == modes["return"]


def waypoint_file(path: Path) -> list[tuple[int, int, float]]:
    """Writes home, a take-off and nine waypoints as QGC WPL 110; the places of the waypoints."""
    places = [(-300_689_800 + 1377 * index, -511_217_900 - 2511 * index, 20.0 + index) for index in range(9)]
    lines = ["QGC WPL 110", f"0\t1\t0\t16\t0\t0\t0\t0\t{HOME[0]:.7f}\t{HOME[1]:.7f}\t50\t1", "1\t0\t3\t22\t0\t0\t0\t0\t0\t0\t20\t1"]
    for index, (latitude, longitude, height) in enumerate(places, 2):
        lines.append(f"{index}\t0\t3\t16\t0\t0\t0\t0\t{latitude / 1e7:.7f}\t{longitude / 1e7:.7f}\t{height:.1f}\t1")
    path.write_text("\n".join(lines) + "\n")
    return places


def test_a_mission_that_it_uploads_is_what_pymavlink_reads(vehicle: Vehicle, tmp_path: Path) -> None:
    file = tmp_path / "mission.waypoints"
    places = waypoint_file(file)
    first = 1 if vehicle.autopilot == "ardupilot" else 0
    (uploaded,) = vehicle.tell_json("mission", "upload", str(file))
    assert uploaded["items"] == first + 1 + len(places)
    assert uploaded["as_file"] == (vehicle.autopilot == "ardupilot")
    items = vehicle.witness.mission()
    assert [item.command for item in items[first:]] == [22] + [16] * len(places)
    assert [(item.x, item.y, item.z) for item in items[first + 1 :]] == places

    again = tmp_path / "again.waypoints"
    vehicle.tell("mission", "download", str(again))
    read = [line.split("\t") for line in again.read_text().splitlines()[3:]]
    assert [(round(float(row[8]) * 1e7), round(float(row[9]) * 1e7), float(row[10])) for row in read] == places
    vehicle.tell("mission", "clear")
    assert len(vehicle.witness.mission()) <= first


def test_flies_a_mission(vehicle: Vehicle, tmp_path: Path) -> None:
    file = tmp_path / "mission.waypoints"
    waypoint_file(file)
    vehicle.tell("mission", "upload", str(file))
    vehicle.tell("start")
    vehicle.tell("mission", "set", "4")
    assert vehicle.witness.next("MISSION_ITEM_REACHED").seq >= 1
    assert vehicle.witness.is_armed()


def test_parameters_are_what_pymavlink_reads(vehicle: Vehicle, tmp_path: Path) -> None:
    name = "BATT_LOW_VOLT" if vehicle.autopilot == "ardupilot" else "MIS_TAKEOFF_ALT"
    (value,) = vehicle.tell_json("params", "set", name, "12.5")
    assert value["value"] == 12.5
    assert vehicle.witness.parameter(name).param_value == 12.5
    (value,) = vehicle.tell_json("params", "get", name)
    assert (value["name"], value["value"], value["type"]) == (name, 12.5, mavlink.MAV_PARAM_TYPE_REAL32)

    file = tmp_path / "all.parm"
    vehicle.tell("params", "save", str(file))
    saved = dict(line.split() for line in file.read_text().splitlines() if not line.startswith("#"))
    assert len(saved) == vehicle.witness.parameter(name).param_count
    assert float(saved[name]) == 12.5
    file.write_text(f"{name} 11.25\n")
    vehicle.tell("params", "load", str(file))
    assert vehicle.witness.parameter(name).param_value == 11.25


def test_a_refusal_ends_with_status_1_and_says_why(vehicle: Vehicle, tmp_path: Path) -> None:
    assert "this autopilot has no such mode" in vehicle.tell("mode", "NO_SUCH_MODE", status=1).stderr
    refused = vehicle.tell("command", "31000", status=1)
    assert "MAV_RESULT_UNSUPPORTED" in refused.stderr
    assert "expected LAT,LON,HEIGHT" in vehicle.tell("goto", "1,2", status=2).stderr
    unknown = vehicle.tell("params", "get", "NO_SUCH_PARAM", status=1)
    assert "params get NO_SUCH_PARAM" in unknown.stderr
    file = tmp_path / "wrong.parm"
    file.write_text("RTL_ALT x\n")
    assert "line 1" in vehicle.tell("params", "load", str(file), status=1).stderr


def test_ardupilot_gives_files(vehicle: Vehicle, tmp_path: Path) -> None:
    if vehicle.autopilot == "px4":
        assert "the vehicle does not answer" in vehicle.tell("files", "list", "/", status=1).stderr
        return
    assert {entry["name"] for entry in vehicle.tell_json("files", "list", "@MISSION")} == {"mission.dat", "fence.dat", "rally.dat"}
    vehicle.tell("files", "get", "@MISSION/rally.dat", str(tmp_path / "rally.dat"))
    assert (tmp_path / "rally.dat").read_bytes()[:2] == b"\x3d\x76"


def test_without_a_vehicle_it_says_so(ponte: Path) -> None:
    result = run([ponte, "vehicle", f"udpout://127.0.0.1:{free_port()}", "--patience", "0.5", "arm"])
    assert result.returncode == 1
    assert "no vehicle was heard" in result.stderr


def test_a_vehicle_that_does_not_sign_is_refused_by_name(vehicle: Vehicle, tmp_path: Path) -> None:
    key = tmp_path / "key"
    key.write_text("5a" * 32)
    key.chmod(0o600)
    signed = ("--mavlink", "2-signed-only", "--signing-key", str(key))
    refused = vehicle.tell(*signed, "--patience", "2", "arm", status=1)
    assert "no vehicle was heard" in refused.stderr
    assert "unsigned" in refused.stderr
