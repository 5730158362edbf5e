"""How `ponte sim` flies, as pymavlink sees it on real sockets: planes, wind, faults, many at once."""

from __future__ import annotations

import math
import socket
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink

from programs import HANG_LIMIT_S, run
from sim_station import COMPONENT, SYSTEM, Station

pytestmark = pytest.mark.once

StartPonte = Callable[..., None]

HOME = (-30.06898, -51.12179)
METRES_PER_DEGREE = 110_850.0  # of latitude, there
TAKE_OFF, WAYPOINT, TURNS, LAND = 22, 16, 18, 21


def item(index: int, command: int, north: float, east: float, height: float, *parameters: float) -> Any:
    """An item so many metres from home."""
    latitude = HOME[0] + north / METRES_PER_DEGREE
    longitude = HOME[1] + east / (METRES_PER_DEGREE * math.cos(math.radians(HOME[0])))
    values = [*parameters, *[0.0] * (4 - len(parameters))]
    frame = mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT
    return mavlink.MAVLink_mission_item_int_message(
        SYSTEM, COMPONENT, index, frame, command, 0, 1, *values, round(latitude * 1e7), round(longitude * 1e7), height, 0
    )


def request_all(station: Station, rate: int = 10) -> None:
    station.send(mavlink.MAVLink_request_data_stream_message(SYSTEM, COMPONENT, 0, rate, 1))


def set_mode(station: Station, number: int) -> None:
    assert station.command(mavlink.MAV_CMD_DO_SET_MODE, 1, number) == mavlink.MAV_RESULT_ACCEPTED


def arm(station: Station) -> None:
    assert station.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1) == mavlink.MAV_RESULT_ACCEPTED


def armed(heartbeat: Any) -> bool:
    return bool(heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)


def test_a_plane_flies_its_mission_in_the_wind_and_lands(start_ponte: StartPonte) -> None:
    station = Station(start_ponte, "--type", "plane", "--wind", "5,300,0.1", "--speedup", "20")
    items = [
        item(0, WAYPOINT, 0, 0, 0),
        item(1, TAKE_OFF, 300, 0, 50),
        item(2, WAYPOINT, 500, 0, 70),
        item(3, TURNS, 300, 500, 70, 1, 0, 90),
        item(4, WAYPOINT, -700, 0, 40),
        item(5, WAYPOINT, -500, 0, 25),
        item(6, LAND, 0, 0, 0),
    ]
    station.upload(items)
    station.until_position()
    request_all(station)
    set_mode(station, 10)
    arm(station)

    reached: list[int] = []
    banks: list[float] = []
    speeds: list[float] = []
    while True:
        message = station.next("MISSION_ITEM_REACHED", "ATTITUDE", "VFR_HUD", "HEARTBEAT", "GLOBAL_POSITION_INT")
        kind = message.get_type()
        if kind == "MISSION_ITEM_REACHED":
            reached.append(message.seq)
        elif kind == "ATTITUDE":
            banks.append(abs(math.degrees(message.roll)))
        elif kind == "VFR_HUD" and message.climb > -3 and reached:
            speeds.append(message.groundspeed)
        elif kind == "GLOBAL_POSITION_INT":
            place = message
        elif kind == "HEARTBEAT" and reached and not armed(message):
            break
    assert reached == [1, 2, 3, 4, 5]
    assert 30 < max(banks) < 46
    assert max(speeds) - min(speeds) > 6, "with the wind and against it"
    assert abs(place.lat * 1e-7 - HOME[0]) * METRES_PER_DEGREE < 150
    assert abs(place.relative_alt) < 500  # mm


def test_a_low_battery_brings_the_copter_home(start_ponte: StartPonte) -> None:
    station = Station(start_ponte, "--fault", "battery-low@40s", "--param", "BATT_FS_LOW_ACT=2", "--speedup", "20")
    request_all(station, 4)
    station.until_position()
    set_mode(station, 4)
    arm(station)
    assert station.command(mavlink.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, 20) == mavlink.MAV_RESULT_ACCEPTED
    texts: list[str] = []
    modes: list[int] = []
    while not modes or armed(heartbeat):
        message = station.next("HEARTBEAT", "STATUSTEXT")
        if message.get_type() == "STATUSTEXT":
            texts.append(message.text)
            continue
        heartbeat = message
        if not modes or modes[-1] != heartbeat.custom_mode:
            modes.append(heartbeat.custom_mode)
    assert modes == [4, 6], "GUIDED, RTL"
    assert heartbeat.system_status == mavlink.MAV_STATE_CRITICAL, "still after landing"
    assert any(text.startswith("Battery 1 is low 10.") for text in texts)
    assert "Battery Failsafe" in texts


def test_faults_can_be_typed_while_it_runs(ponte: Path) -> None:
    link = mavutil.mavlink_connection("udpin:127.0.0.1:0", source_system=255)
    endpoint = f"udpout://127.0.0.1:{link.port.getsockname()[1]}"
    command = [str(ponte), "sim", "--endpoint", endpoint, "--vehicles", "2", "--fault", "-"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdin is not None and process.stderr is not None
        process.stdin.write("2:reboot\nnonsense\n")
        process.stdin.flush()
        lines = [process.stderr.readline() for _ in range(3)]
        assert "each of 2 vehicles" in lines[0]
        assert "vehicle 2: reboot" in lines[1]
        assert "no such fault: nonsense" in lines[2]
        process.terminate()
        assert process.wait(HANG_LIMIT_S) == 0


@pytest.mark.parametrize("shared", [True, False], ids=["one_endpoint", "one_each"])
def test_many_vehicles_speak_at_once(start_ponte: StartPonte, shared: bool) -> None:
    count = 20
    sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(1 if shared else count)]
    options: list[str] = []
    for each in sockets:
        each.bind(("127.0.0.1", 0))
        each.settimeout(HANG_LIMIT_S)
        options += ["--endpoint", f"udpout://127.0.0.1:{each.getsockname()[1]}"]
    start_ponte("sim", *options, "--vehicles", str(count), "--system", "11", "--quiet")
    heard: list[set[int]] = []
    for each in sockets:
        parser = mavlink.MAVLink(None)
        systems: set[int] = set()
        while len(systems) < (count if shared else 1):
            for message in parser.parse_buffer(each.recv(2048)) or []:
                systems.add(message.get_srcSystem())
        heard.append(systems)
    expected = set(range(11, 11 + count))
    assert heard == ([expected] if shared else [{system} for system in sorted(expected)])


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (["--fault", "engine@5s"], "no fault is called 'engine'; there are battery-low"),
        (["--fault", "gps-loss@soon"], "--fault gps-loss@soon: expected a time after @"),
        (["--fault", "reboot@5s+3s"], "reboot does not pass"),
        (["--wind", "5"], "--wind 5: expected SPEED,FROM[,GUSTS]"),
        (["--wind", "5,90,7"], "--wind 5,90,7: expected gusts from 0 to 1"),
        (["--vehicles", "200", "--system", "100"], "--vehicles 200: system ids end at 255"),
        (["--vehicles", "3", "--endpoint", "udpout://127.0.0.1:1", "--endpoint", "udpout://127.0.0.1:2"], "there are 2"),
        (["--type", "balloon"], "--type"),
    ],
)
def test_it_says_what_it_does_not_understand(ponte: Path, options: list[str], reason: str) -> None:
    result = run([ponte, "sim", *options])
    assert result.returncode == 2
    assert reason in result.stderr
