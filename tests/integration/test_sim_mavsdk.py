"""`ponte sim` before MAVSDK, which takes it for a real PX4 or ArduCopter.

Everything is flown 10 times as fast. What MAVSDK cannot do with one of the autopilots is a skipped test of its own.
"""

from __future__ import annotations

import socket
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import pytest
from mavsdk import ComponentType, Configuration, Mavsdk
from mavsdk.plugins.action import Action
from mavsdk.plugins.geofence import FenceType, Geofence, GeofenceData, Point, Polygon
from mavsdk.plugins.gimbal import ControlMode, Gimbal, GimbalMode, SendMode
from mavsdk.plugins.mission import Mission, MissionItem, MissionPlan
from mavsdk.plugins.mission_raw import MissionItem as RawItem
from mavsdk.plugins.mission_raw import MissionRaw
from mavsdk.plugins.param import Param, ParamError
from mavsdk.plugins.telemetry import FlightMode, Telemetry
from programs import HANG_LIMIT_S

pytestmark = pytest.mark.once

PX4, ARDUPILOT = "px4", "ardupilot"
HOME = (-30.06898, -51.12179)
ITEMS = 20
PATIENCE_S = 60  # no judgement of speed: it ends a test that hangs


@dataclass
class Drone:
    """One vehicle, as MAVSDK sees it."""

    autopilot: str
    system: Any
    telemetry: Any
    action: Any

    @property
    def is_px4(self) -> bool:
        return self.autopilot == PX4

    def fly_up(self) -> None:
        self.action.set_takeoff_altitude(10.0)
        self.action.arm()
        self.action.takeoff()
        until(lambda: self.telemetry.position().relative_altitude_m > 9, "it has climbed")

    def until_disarmed(self) -> None:
        until(lambda: not self.telemetry.armed(), "it is disarmed")


def until(condition: Callable[[], bool], what: str) -> None:
    end = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end, f"MAVSDK never saw that {what}"
        time.sleep(0.02)


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@pytest.fixture(params=[PX4, ARDUPILOT])
def drone(request: pytest.FixtureRequest, start_ponte: Callable[..., None]) -> Iterator[Drone]:
    """A vehicle with a gimbal that is ready to be armed, or, with `ardupilot`, that knows its home."""
    autopilot = request.param
    port = free_port()
    gimbal = "MNT_MODE_IN=4" if autopilot == PX4 else "MNT1_TYPE=1"
    with Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION)) as mavsdk:
        mavsdk.add_any_connection(f"udpin://127.0.0.1:{port}")
        start_ponte(
            "sim", "--autopilot", autopilot, "--endpoint", f"udpout://127.0.0.1:{port}", "--speedup", "10",
            "--param", gimbal, "--quiet",
        )  # fmt: skip
        system = mavsdk.first_autopilot(HANG_LIMIT_S)
        assert system is not None
        result = Drone(autopilot, system, Telemetry(system), Action(system))
        result.telemetry.set_rate_position(10.0)  # ArduPilot sends what it is asked for
        result.telemetry.set_rate_landed_state(10.0)
        until(lambda: result.telemetry.health().is_home_position_ok, "it knows its home")
        yield result


def test_it_is_healthy(drone: Drone) -> None:
    if not drone.is_px4:
        pytest.skip("MAVSDK's health stays false with a real ArduPilot, too")
    until(drone.telemetry.health_all_ok, "all is well")


def test_parameters(drone: Drone) -> None:
    parameters = Param(drone.system)
    everything = parameters.get_all_params()
    names = {each.name for each in [*everything.int_params, *everything.float_params]}
    whole, real = ("NAV_DLL_ACT", "MIS_TAKEOFF_ALT") if drone.is_px4 else ("FS_GCS_ENABLE", "BATT_LOW_VOLT")
    assert {whole, real} <= names
    parameters.set_param_int(whole, 2)
    parameters.set_param_float(real, 12.5)
    assert parameters.get_param_int(whole) == 2
    assert parameters.get_param_float(real) == 12.5
    with pytest.raises(ParamError):
        parameters.get_param_int("NO_SUCH_PARAM")


def test_flies_up_returns_and_lands(drone: Drone) -> None:
    drone.fly_up()
    drone.action.return_to_launch()
    until(lambda: drone.telemetry.flight_mode() == FlightMode.RETURN_TO_LAUNCH, "it returns")
    drone.action.land()
    until(lambda: drone.telemetry.flight_mode() == FlightMode.LAND, "it lands")
    drone.until_disarmed()


def test_flies_a_mission_of_20_items(drone: Drone) -> None:
    if not drone.is_px4:
        pytest.skip("MAVSDK's Mission plugin knows no home item; see the raw mission below")
    mission = Mission(drone.system)
    items = [
        MissionItem(HOME[0] + 0.0001 * index, HOME[1], 20, 10, True, camera_photo_interval_s=float("nan"))
        for index in range(ITEMS)
    ]
    mission.upload_mission(MissionPlan(items))
    stored = mission.download_mission().mission_items
    assert [round(each.latitude_deg, 7) for each in stored] == [round(each.latitude_deg, 7) for each in items]
    progress: set[int] = set()
    mission.subscribe_mission_progress(lambda value, _context: progress.add(value.current), None)
    drone.action.arm()
    mission.start_mission()
    until(mission.is_mission_finished, "the mission is finished")
    until(lambda: progress >= set(range(ITEMS + 1)), "every item had its turn")
    drone.action.return_to_launch()
    drone.until_disarmed()
    mission.clear_mission()


def test_flies_a_raw_mission_of_20_items(drone: Drone) -> None:
    mission = MissionRaw(drone.system)
    relative, take_off, waypoint, land = 6, 22, 16, 21

    def item(index: int, command: int) -> RawItem:
        latitude = round((HOME[0] + 0.0001 * (index % 10)) * 1e7)
        height = 0.0 if command == land else 15.0
        return RawItem(index, relative, command, int(index == 0), 1, 0.0, 0.0, 0.0, 0.0, latitude, round(HOME[1] * 1e7), height, 0)

    first = 0 if drone.is_px4 else 1  # ArduPilot's item 0 is home
    commands = [waypoint] * first + [take_off] + [waypoint] * (ITEMS - 2) + [land]
    mission.upload_mission([item(index, command) for index, command in enumerate(commands)])
    stored = mission.download_mission()
    assert [each.command for each in stored] == commands
    progress: set[int] = set()
    mission.subscribe_mission_progress(lambda value, _context: progress.add(value.current), None)
    if not drone.is_px4:
        drone.fly_up()  # in AUTO alone an ArduCopter stays on the ground
    else:
        drone.action.arm()
    mission.start_mission()
    until(lambda: len(commands) - 1 in progress, "it came to the last item")
    drone.until_disarmed()
    assert progress >= set(range(first + 2, len(commands)))


def test_geofence(drone: Drone) -> None:
    corners = [(-0.01, -0.01), (-0.01, 0.01), (0.01, 0.01), (0.01, -0.01)]
    points = [Point(HOME[0] + north, HOME[1] + east) for north, east in corners]
    fence = Geofence(drone.system)
    fence.upload_geofence(GeofenceData([Polygon(points, FenceType.INCLUSION)], []))
    stored = fence.download_geofence().polygons
    assert [[round(point.latitude_deg, 7) for point in each.points] for each in stored] == [
        [round(point.latitude_deg, 7) for point in points]
    ]
    fence.clear_geofence()


def test_gimbal(drone: Drone) -> None:
    gimbal = Gimbal(drone.system)
    until(lambda: bool(gimbal.gimbal_list().gimbals), "there is a gimbal")
    number = gimbal.gimbal_list().gimbals[0].gimbal_id
    gimbal.take_control(number, ControlMode.PRIMARY)
    until(lambda: gimbal.get_control_status(number).control_mode == ControlMode.PRIMARY, "it has control")
    gimbal.set_angles(number, 0.0, -30.0, 20.0, GimbalMode.YAW_FOLLOW, SendMode.ONCE)
    gimbal.subscribe_attitude(lambda _value, _context: None, None)
    if drone.is_px4:  # ArduPilot has to be asked for its stream, which MAVSDK does not do
        until(lambda: abs(gimbal.get_attitude(number).euler_angle_forward.pitch_deg + 30) < 1, "it looks down")
    gimbal.release_control(number)
