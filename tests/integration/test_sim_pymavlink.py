"""`ponte sim` before pymavlink: what has to arrive whatever the link loses, and in MAVLink 1 as well."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from programs import seed_or
from pymavlink import mavftp
from sim_station import COMPONENT, SYSTEM, Station, mavlink, waypoint

AUTOPILOTS = ["ardupilot", "px4"]
StartPonte = Callable[..., None]


def places(items: list[Any]) -> list[tuple[int, int, float]]:
    return [(item.x, item.y, item.z) for item in items]


@pytest.mark.once
@pytest.mark.parametrize("autopilot", AUTOPILOTS)
def test_a_mission_of_1000_items_arrives_though_a_fifth_is_lost_each_way(start_ponte: StartPonte, autopilot: str) -> None:
    seed = seed_or(1)
    print(f"PONTE_SEED={seed}")
    station = Station(start_ponte, "--autopilot", autopilot, "--mission-items", "1000", "--speedup", "10", loss=0.2, seed=seed)
    station.silence_telemetry()
    wanted = [waypoint(index) for index in range(1000)]
    station.upload(wanted)
    stored = station.download()
    assert len(stored) == 1000
    first = 1 if autopilot == "ardupilot" else 0  # item 0 of ArduPilot is home
    assert places(stored[first:]) == places(wanted[first:])


@pytest.mark.parametrize("autopilot", AUTOPILOTS)
def test_it_speaks_mavlink_1(start_ponte: StartPonte, autopilot: str) -> None:
    station = Station(start_ponte, "--autopilot", autopilot, "--mavlink", "1", "--speedup", "10", v1=True)
    wanted = [waypoint(index) for index in range(12)]
    station.upload(wanted)
    stored = station.download()
    assert stored[0].get_msgbuf()[0] == 0xFE
    assert places(stored[1:]) == places(wanted[1:])
    station.until_position()
    assert station.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1) == mavlink.MAV_RESULT_ACCEPTED


@pytest.mark.parametrize("autopilot", AUTOPILOTS)
def test_a_signed_link_carries_a_mission_and_commands(start_ponte: StartPonte, tmp_path: Path, autopilot: str) -> None:
    key_file = tmp_path / "key"
    key_file.write_text("5a" * 32)
    key_file.chmod(0o600)
    signed = ("--mavlink", "2-signed-only", "--signing-key", str(key_file))
    station = Station(start_ponte, "--autopilot", autopilot, *signed, "--speedup", "5", key=b"\x5a" * 32)
    station.silence_telemetry()  # every signature takes pymavlink its time
    wanted = [waypoint(index) for index in range(12)]
    station.upload(wanted)
    stored = station.download()
    assert all(item.get_signed() for item in stored)
    assert places(stored[1:]) == places(wanted[1:])
    station.until_position()
    assert station.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1) == mavlink.MAV_RESULT_ACCEPTED


@pytest.mark.parametrize("autopilot", AUTOPILOTS)
def test_every_parameter_arrives_and_can_be_set(start_ponte: StartPonte, autopilot: str) -> None:
    station = Station(start_ponte, "--autopilot", autopilot)
    station.send(mavlink.MAVLink_param_request_list_message(SYSTEM, COMPONENT))
    values: dict[str, Any] = {}
    indices: set[int] = set()
    while True:
        value = station.next("PARAM_VALUE")
        values[value.param_id] = value
        if value.param_index < value.param_count:
            indices.add(value.param_index)
        if indices and len(indices) == value.param_count:
            break
    # ArduPilot sends an integer as the float of the number, PX4 its bits.
    name, kind = ("COM_DL_LOSS_T", 6) if autopilot == "px4" else ("RTL_ALT", 6)
    sent = values[name].param_value
    number = struct.unpack("<i", struct.pack("<f", sent))[0] if autopilot == "px4" else int(sent)
    assert number == (10 if autopilot == "px4" else 1500)
    new = struct.unpack("<f", struct.pack("<i", 12))[0] if autopilot == "px4" else 1200.0
    station.send(mavlink.MAVLink_param_set_message(SYSTEM, COMPONENT, name.encode(), new, kind))
    while (value := station.next("PARAM_VALUE")).param_id != name:
        pass
    assert value.param_value == new
    assert ("_HASH_CHECK" in values) == (autopilot == "px4")


def test_ardupilot_gives_and_takes_files(start_ponte: StartPonte, tmp_path: Any) -> None:
    station = Station(start_ponte, "--speedup", "2")
    station.until_position()
    station.upload([waypoint(index) for index in range(30)])
    ftp = mavftp.MAVFTP(station.link, SYSTEM, COMPONENT)
    got = tmp_path / "mission.dat"
    ftp.cmd_get(["@MISSION/mission.dat", str(got)])
    ftp.process_ftp_reply("OpenFileRO", timeout=60)
    content = got.read_bytes()
    magic, kind, _options, start, count = struct.unpack_from("<5H", content)
    assert (magic, kind, start, count, len(content)) == (0x763D, 0, 0, 30, 10 + 38 * 30)

    shorter = tmp_path / "shorter.dat"
    shorter.write_bytes(struct.pack("<5H", magic, 0, 0, 0, 20) + content[10 : 10 + 38 * 20])
    ftp.cmd_put([str(shorter), "@MISSION/mission.dat"])
    ftp.process_ftp_reply("CreateFile", timeout=60)
    assert len(station.download()) == 20
