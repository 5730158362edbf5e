"""What #3002, #3009, #3010 and #4000 must hold for given MAVLink values, calculated apart from Ponte.

There is one function for each MAVLink message. It is given the fields of the message (no extensions in MAVLink 1) and
what other messages have made known, and tells of every DLI field that the message is a source of. Raw values are those
on the wire in Edition 3.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import flight_maths
from dli_tables import tables

OPERATING, AIR, BODY, INERTIAL = 3002, 3009, 3010, 4000

STANDARD_GRAVITY = 9.80665  # m/s^2
SEA_LEVEL_DENSITY = 1.225  # kg/m^3
AIR_GAS_CONSTANT = 287.053  # J/(kg K)
ALTITUDE_TYPE_AGL = 2
LOOKS_DOWN = 25  # MAV_SENSOR_ROTATION_PITCH_270
INVALID_SIGNAL = 1  # percent, while 0 says nothing of the signal
FIX_3D = 3
UNKNOWN_TERRAIN_BELOW = -1000.0  # m, see ALTITUDE.altitude_terrain
FRAMES_OVER_SEA, FRAMES_OVER_HOME, FRAMES_OVER_TERRAIN = {0, 5}, {3, 6}, {10, 11}
IGNORE_Z, IGNORE_YAW, IGNORE_ATTITUDE = 4, 1024, 128

Fields = dict[str, Any]


class Told(NamedTuple):
    """A fact that a MAVLink message is the source of, and the DLI field that it becomes; raw: nothing when unknown."""

    source: str
    fact: str
    number: int
    field: int
    raw: int | None


@dataclass
class Known:
    """What earlier messages have told, as far as the meaning of later ones depends on it."""

    rotorcraft: bool = True
    navigates: bool = False
    attitude: tuple[float, float, float] | None = None
    pressure_pa: float | None = None
    temperature_k: float | None = None
    home_altitude: float | None = None


def raw_of(number: int, field: int, value: float | None) -> int | None:
    """A value in the unit of its field as the raw integer; nothing where it is unknown or does not fit."""
    entry = tables("3")[number].fields[field]
    if value is None or not math.isfinite(value) or entry.factor is None or entry.raw_range is None:
        return None
    raw = flight_maths.round_half_away(value / entry.factor)
    if entry.kind == "b":
        return flight_maths.wrap_signed(raw, entry.width)
    low, high = entry.raw_range
    return raw if low <= raw <= high else None


def told(source: str, number: int, values: dict[tuple[str, int], float | None]) -> Iterator[Told]:
    """Several facts of one source, by name and field."""
    for (fact, field), value in values.items():
        yield Told(source, fact, number, field, raw_of(number, field, value))


def attitude(m: Fields, known: Known) -> Iterator[Told]:
    angles = (m["roll"], m["pitch"], m["yaw"])
    known.attitude = angles if all(math.isfinite(angle) for angle in angles) else None
    fields = flight_maths.attitude_fields(*angles, m["rollspeed"], m["pitchspeed"], m["yawspeed"])
    names = ("roll", "pitch", "heading", "roll_rate", "pitch_rate", "turn_rate")
    for field, fact in enumerate(names, start=12):
        yield Told("ATTITUDE", fact, INERTIAL, field, fields.get(field))


def global_position_int(m: Fields, known: Known) -> Iterator[Told]:
    """Latitude and longitude 0 are what autopilots send before they have a position."""
    has_position = m["lat"] != 0 or m["lon"] != 0
    values = [m[name] for name in ("lat", "lon", "alt", "vx", "vy", "vz")]
    fields = flight_maths.position_fields(*values) if has_position else {}
    facts = {
        2: "latitude", 3: "longitude", 4: "altitude_msl", 5: "altitude_msl",
        6: "north_speed", 7: "east_speed", 8: "down_speed",
    }  # fmt: skip
    for field, fact in facts.items():
        yield Told("GLOBAL_POSITION_INT", fact, INERTIAL, field, fields.get(field))
    for field, fact, same in ((15, "north_speed", 6), (16, "east_speed", 7)):
        yield Told("GLOBAL_POSITION_INT", fact, AIR, field, fields.get(same))


def earth_acceleration(
    body: tuple[float, float, float], angles: tuple[float, float, float] | None
) -> tuple[float, float, float] | None:
    """What accelerometers feel, turned into north, east and down, with gravity, which they do not feel, added."""
    if angles is None or not all(math.isfinite(part) for part in body):
        return None
    (x, y, z), (roll, pitch, yaw) = body, angles
    # About the body's x axis, then y, then z: each turn leaves its own axis alone.
    y, z = y * math.cos(roll) - z * math.sin(roll), y * math.sin(roll) + z * math.cos(roll)
    x, z = x * math.cos(pitch) + z * math.sin(pitch), -x * math.sin(pitch) + z * math.cos(pitch)
    x, y = x * math.cos(yaw) - y * math.sin(yaw), x * math.sin(yaw) + y * math.cos(yaw)
    return x, y, z + STANDARD_GRAVITY


def inertial_sensors(source: str, body: list[float], rates: list[float], known: Known) -> Iterator[Told]:
    names = (
        "body_x_acceleration", "body_y_acceleration", "body_z_acceleration",
        "body_roll_rate", "body_pitch_rate", "body_yaw_rate",
    )  # fmt: skip
    for field, (fact, value) in enumerate(zip(names, body + rates), start=2):
        yield Told(source, fact, BODY, field, raw_of(BODY, field, value))
    acceleration = earth_acceleration((body[0], body[1], body[2]), known.attitude)
    for index, fact in enumerate(("north_acceleration", "east_acceleration", "down_acceleration")):
        value = acceleration[index] if acceleration else None
        yield Told(source, fact, INERTIAL, 9 + index, raw_of(INERTIAL, 9 + index, value))


def highres_imu(m: Fields, known: Known) -> Iterator[Told]:
    """Bits 0 to 2 of fields_updated are the accelerations, 3 to 5 the rates; other IMUs than id 0 do not count."""
    names = ("xacc", "yacc", "zacc", "xgyro", "ygyro", "zgyro")
    first = m.get("id", 0) == 0
    values = [m[name] if first and m["fields_updated"] >> bit & 1 else math.nan for bit, name in enumerate(names)]
    yield from inertial_sensors("HIGHRES_IMU", values[:3], values[3:], known)


def scaled_imu(m: Fields, known: Known) -> Iterator[Told]:
    body = [m[name] * STANDARD_GRAVITY / 1000 for name in ("xacc", "yacc", "zacc")]
    rates = [m[name] / 1000 for name in ("xgyro", "ygyro", "zgyro")]
    yield from inertial_sensors("SCALED_IMU", body, rates, known)


def scaled_pressure(m: Fields, known: Known) -> Iterator[Told]:
    pressure, kelvin = m["press_abs"], m["temperature"] / 100 + 273.15
    known.pressure_pa = pressure * 100 if pressure > 0 else None
    known.temperature_k = kelvin if kelvin > 0 else None
    altitude_m = 44330.77 * (1 - (pressure / 1013.25) ** 0.190263) if pressure > 0 else None
    yield from told(
        "SCALED_PRESSURE", AIR, {("pressure_altitude", 12): altitude_m, ("air_temperature", 6): known.temperature_k}
    )


def true_airspeed(airspeed: float | None, known: Known) -> float | None:
    if airspeed is None or known.pressure_pa is None or known.temperature_k is None:
        return None
    density = known.pressure_pa / (AIR_GAS_CONSTANT * known.temperature_k)
    return airspeed * math.sqrt(SEA_LEVEL_DENSITY / density)


def vfr_hud(m: Fields, known: Known) -> Iterator[Told]:
    """A rotorcraft's airspeed of 0 is that of one without a sensor."""
    airspeed = None if known.rotorcraft and m["airspeed"] == 0 else m["airspeed"]
    true = true_airspeed(airspeed, known)
    yield from told(
        "VFR_HUD",
        AIR,
        {
            ("indicated_airspeed", 5): airspeed,
            ("true_airspeed", 4): true,
            ("barometric_altitude", 10): m["alt"],
            ("climb_rate", 11): m["climb"],
        },
    )
    yield Told("SCALED_PRESSURE", "static_pressure", AIR, 4, raw_of(AIR, 4, true))
    yield from told("VFR_HUD", OPERATING, {("power_level", 10): m["throttle"]})


def wind(m: Fields, known: Known) -> Iterator[Told]:
    """The direction is the one that the wind comes from, U and V are where it goes."""
    north = -m["speed"] * math.cos(math.radians(m["direction"]))
    east = -m["speed"] * math.sin(math.radians(m["direction"]))
    yield from told("WIND", AIR, {("north_wind", 7): north, ("east_wind", 8): east})


def wind_cov(m: Fields, known: Known) -> Iterator[Told]:
    yield from told("WIND_COV", AIR, {("north_wind", 7): m["wind_x"], ("east_wind", 8): m["wind_y"]})


def aoa_ssa(m: Fields, known: Known) -> Iterator[Told]:
    attack, sideslip = math.radians(m["AOA"]), math.radians(m["SSA"])
    yield from told("AOA_SSA", AIR, {("angle_of_attack", 2): attack, ("sideslip", 3): sideslip})


def distance_sensor(m: Fields, known: Known) -> Iterator[Told]:
    in_range = m["min_distance"] <= m["current_distance"] <= m["max_distance"]
    usable = m["orientation"] == LOOKS_DOWN and in_range and m.get("signal_quality") != INVALID_SIGNAL
    height = m["current_distance"] / 100 if usable else None
    yield from told("DISTANCE_SENSOR", AIR, {("height_above_ground", 13): height})


def altitude(m: Fields, known: Known) -> Iterator[Told]:
    height = m["altitude_terrain"] if m["altitude_terrain"] >= UNKNOWN_TERRAIN_BELOW else None
    yield from told("ALTITUDE", AIR, {("height_above_ground", 13): height})


def terrain_report(m: Fields, known: Known) -> Iterator[Told]:
    height = m["current_height"] if m["spacing"] != 0 else None
    yield from told("TERRAIN_REPORT", AIR, {("height_above_ground", 13): height})


def gps_raw_int(m: Fields, known: Known) -> Iterator[Told]:
    millimetres = m.get("alt_ellipsoid", 0)
    height = millimetres / 1000 if m["fix_type"] >= FIX_3D and millimetres != 0 else None
    yield from told("GPS_RAW_INT", AIR, {("altitude_ellipsoid", 14): height})


def home_position(m: Fields, known: Known) -> Iterator[Told]:
    known.home_altitude = m["altitude"] / 1000
    return iter(())


def position_target_global_int(m: Fields, known: Known) -> Iterator[Told]:
    height = None if m["type_mask"] & IGNORE_Z or not math.isfinite(m["alt"]) else m["alt"]
    frame, source = m["coordinate_frame"], "POSITION_TARGET_GLOBAL_INT"
    if frame in FRAMES_OVER_TERRAIN:
        fact, reference, kind = "commanded_height_above_ground", 0.0, ALTITUDE_TYPE_AGL
    else:
        over_home = known.home_altitude if frame in FRAMES_OVER_HOME else None
        reference = 0.0 if frame in FRAMES_OVER_SEA else over_home
        fact, kind = "commanded_altitude_msl", flight_maths.ALTITUDE_TYPE_WGS84
    raw = None if height is None or reference is None else raw_of(OPERATING, 2, height + reference)
    yield Told(source, fact, OPERATING, 2, raw)
    yield Told(source, fact, OPERATING, 3, None if raw is None else kind)
    if frame in FRAMES_OVER_HOME:
        yield Told("HOME_POSITION", "home_altitude_msl", OPERATING, 2, raw)
    yield from told(source, OPERATING, {("commanded_heading", 4): None if m["type_mask"] & IGNORE_YAW else m["yaw"]})


def attitude_target(m: Fields, known: Known) -> Iterator[Told]:
    w, x, y, z = m["q"]
    usable = not m["type_mask"] & IGNORE_ATTITUDE and all(math.isfinite(part) for part in m["q"]) and any(m["q"])
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)) if usable else None
    heading = math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) if usable else None
    yield from told("ATTITUDE_TARGET", OPERATING, {("commanded_roll", 14): roll, ("commanded_heading", 4): heading})


def nav_controller_output(m: Fields, known: Known) -> Iterator[Told]:
    """What it says has a meaning only while the autopilot navigates; in a manual mode it keeps what it had."""
    facts = (("commanded_heading", 4, "nav_bearing"), ("commanded_course", 5, "target_bearing"))
    for fact, field, name in (*facts, ("commanded_roll", 14, "nav_roll")):
        radians = math.radians(m[name]) if known.navigates else None
        yield Told("NAV_CONTROLLER_OUTPUT", fact, OPERATING, field, raw_of(OPERATING, field, radians))


def battery_status(m: Fields, known: Known) -> Iterator[Told]:
    percent = m["battery_remaining"] if m["id"] == 0 and m["battery_remaining"] >= 0 else None
    yield from told("BATTERY_STATUS", OPERATING, {("energy_level", 12): percent})


def sys_status(m: Fields, known: Known) -> Iterator[Told]:
    percent = m["battery_remaining"] if m["battery_remaining"] >= 0 else None
    yield from told("SYS_STATUS", OPERATING, {("energy_level", 12): percent})


RULES: dict[str, Callable[[Fields, Known], Iterator[Told]]] = {
    rule.__name__: rule
    for rule in (
        attitude, global_position_int, highres_imu, scaled_imu, scaled_pressure, vfr_hud, wind, wind_cov, aoa_ssa,
        distance_sensor, altitude, terrain_report, gps_raw_int, home_position, position_target_global_int,
        attitude_target, nav_controller_output, battery_status, sys_status,
    )
}  # fmt: skip
