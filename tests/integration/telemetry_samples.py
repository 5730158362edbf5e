"""Seeded samples of what an autopilot sends, known and unknown.

A vehicle has its best sources, its second best or its third, never two for one fact: which of two is listened to depends
on how long the better one has been silent.
"""

from __future__ import annotations

import math
import random
from typing import Any

from mavlink_values import float32
from test_random_attitudes import random_attitude

NAN = math.nan
UNKNOWN_SHARE = 0.2
ABSOLUTE_ZERO = -27_315  # in hundredths of a degree Celsius

SOURCES = {
    "best": (
        "attitude", "global_position_int", "highres_imu", "scaled_pressure", "wind", "aoa_ssa", "distance_sensor",
        "gps_raw_int", "home_position", "position_target_global_int", "battery_status", "vfr_hud",
    ),
    "second": (
        "attitude", "global_position_int", "scaled_imu", "scaled_pressure", "wind_cov", "altitude", "attitude_target",
        "sys_status", "vfr_hud",
    ),
    "third": ("attitude", "global_position_int", "terrain_report", "nav_controller_output", "vfr_hud"),
}  # fmt: skip


def maybe(source: random.Random, known: Any, *unknown: Any) -> Any:
    """The known value, or in one case of five a way to say that it is not known. Floats have four bytes."""
    value = source.choice(unknown) if source.random() < UNKNOWN_SHARE else known
    return float32(value) if isinstance(value, float) else value


def floats(source: random.Random, names: str, low: float, high: float) -> dict[str, float]:
    """Values under each of the names, NaN where unknown."""
    return {name: maybe(source, source.uniform(low, high), NAN) for name in names.split()}


def integers(source: random.Random, names: str, low: int, high: int) -> dict[str, int]:
    return {name: source.randint(low, high) for name in names.split()}


def attitude(r: random.Random) -> dict[str, Any]:
    names = ("roll", "pitch", "yaw", "rollspeed", "pitchspeed", "yawspeed")
    values = random_attitude(r)
    unknown = r.choice(names) if r.random() < 2 * UNKNOWN_SHARE else None  # one at most, as most rates need two angles
    return {"time_boot_ms": 0} | {n: float32(NAN if n == unknown else v) for n, v in zip(names, values)}


def global_position_int(r: random.Random) -> dict[str, Any]:
    lat, lon = maybe(r, (r.randint(-900_000_000, 900_000_000), r.randint(-1_800_000_000, 1_799_999_999)), (0, 0))
    rest = integers(r, "vx vy vz", -5000, 5000) | integers(r, "alt", -500_000, 9_000_000)
    return {"time_boot_ms": 0, "lat": lat, "lon": lon, "relative_alt": 0, "hdg": 65535, **rest}


def highres_imu(r: random.Random) -> dict[str, Any]:
    """Some accelerations and rates are beyond what the DLI can say."""
    values = floats(r, "xacc yacc zacc", -40, 40) | floats(r, "xgyro ygyro zgyro", -3.6, 3.6)
    values["xacc"] = maybe(r, values["xacc"], 200.0)
    others = dict.fromkeys("xmag ymag zmag abs_pressure diff_pressure pressure_alt temperature".split(), 0.0)
    updated = maybe(r, 0xFFFF, 0xFFFF & ~(1 << r.randrange(6)))
    # The last rate is always told, so that there is always something to wait for.
    values["zgyro"] = float32(r.uniform(-3.0, 3.0))
    return {"time_usec": 0, **values, **others, "fields_updated": updated | 1 << 5, "id": 0}


def scaled_imu(r: random.Random) -> dict[str, Any]:
    """No value means "unknown" here; some are beyond what the DLI can say, the last never."""
    values = {name: maybe(r, r.randint(-16_000, 16_000), 17_000, -32_768) for name in ("xacc", "yacc", "zacc")}
    values |= {name: maybe(r, r.randint(-3200, 3200), 3300, -32_768) for name in ("xgyro", "ygyro")}
    values["zgyro"] = r.randint(-3200, 3200)
    return {"time_boot_ms": 0, **values, "xmag": 0, "ymag": 0, "zmag": 0}


def scaled_pressure(r: random.Random) -> dict[str, Any]:
    temperature = maybe(r, r.randint(-4000, 6000), -30_000)
    pressure = maybe(r, r.uniform(400.0, 1050.0), NAN, 0.0)
    return {"time_boot_ms": 0, "press_abs": pressure, "press_diff": 0.0, "temperature": temperature}


def vfr_hud(r: random.Random) -> dict[str, Any]:
    values = {"airspeed": maybe(r, r.uniform(1, 150), 0.0, NAN), "throttle": maybe(r, r.randint(0, 100), 65535)}
    height = floats(r, "alt", -400, 9000) | floats(r, "climb", -60, 60)
    return {"groundspeed": 0.0, "heading": 0, **values, **height}


def wind(r: random.Random) -> dict[str, Any]:
    return floats(r, "direction", -180, 360) | floats(r, "speed", 0, 60) | {"speed_z": 0.0}


def wind_cov(r: random.Random) -> dict[str, Any]:
    others = dict.fromkeys("wind_z var_horiz var_vert wind_alt horiz_accuracy vert_accuracy".split(), 0.0)
    return {"time_usec": 0, **floats(r, "wind_x wind_y", -60, 60), **others}


def aoa_ssa(r: random.Random) -> dict[str, Any]:
    return {"time_usec": 0, **floats(r, "AOA SSA", -180, 180)}


def distance_sensor(r: random.Random) -> dict[str, Any]:
    beyond = maybe(r, r.randint(100, 5000), 10, 5010, 65535)
    return {
        "time_boot_ms": 0, "min_distance": 20, "max_distance": 5000, "current_distance": beyond, "type": 0, "id": 0,
        "orientation": maybe(r, 25, 0, 24), "covariance": 255, "signal_quality": maybe(r, r.choice((0, 2, 100)), 1),
    }  # fmt: skip


def altitude(r: random.Random) -> dict[str, Any]:
    others = dict.fromkeys("monotonic amsl local relative".split(), 0.0)
    terrain = maybe(r, r.uniform(-50, 5000), NAN, -1001.0, -1e6)
    named = {f"altitude_{name}": value for name, value in (others | {"terrain": terrain}).items()}
    return {"time_usec": 0, **named, "bottom_clearance": 0.0}


def terrain_report(r: random.Random) -> dict[str, Any]:
    values = floats(r, "current_height", -50, 5000) | {"spacing": maybe(r, 100, 0)}
    return {"lat": 1, "lon": 1, "terrain_height": 0.0, "pending": 0, "loaded": 0, **values}


def gps_raw_int(r: random.Random) -> dict[str, Any]:
    others = dict.fromkeys("time_usec lat lon alt eph epv vel cog satellites_visible".split(), 0)
    height = maybe(r, r.randint(-400_000, 9_000_000), 0)
    return others | {"fix_type": maybe(r, r.choice((3, 4, 6)), 0, 1, 2), "alt_ellipsoid": height}


def home_position(r: random.Random) -> dict[str, Any]:
    others = dict.fromkeys("x y z approach_x approach_y approach_z".split(), 0.0)
    height = r.randint(-400_000, 4_000_000)
    return {"latitude": 1, "longitude": 1, "altitude": height, "q": [1.0, 0.0, 0.0, 0.0], **others}


def position_target_global_int(r: random.Random) -> dict[str, Any]:
    others = dict.fromkeys("vx vy vz afx afy afz yaw_rate".split(), 0.0) | {"lat_int": 0, "lon_int": 0}
    mask = maybe(r, 0, 4) | maybe(r, 0, 1024)
    values = floats(r, "alt", -400, 9000) | floats(r, "yaw", -math.pi, math.pi)
    frame = maybe(r, r.choice((0, 5, 3, 6, 10, 11)), 1)
    return {"time_boot_ms": 0, "coordinate_frame": frame, "type_mask": mask, **values, **others}


def attitude_target(r: random.Random) -> dict[str, Any]:
    roll, pitch, yaw = (angle / 2 for angle in random_attitude(r)[:3])
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(half), math.sin(half)) for half in (roll, pitch, yaw))
    q = (
        cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
    )  # fmt: skip
    sent = [float32(part) for part in maybe(r, q, (NAN,) * 4)]
    rates = dict.fromkeys(("body_roll_rate", "body_pitch_rate", "body_yaw_rate", "thrust"), 0.0)
    return {"time_boot_ms": 0, "type_mask": maybe(r, 0, 128), "q": sent, **rates}


def nav_controller_output(r: random.Random) -> dict[str, Any]:
    others = dict.fromkeys("nav_pitch alt_error aspd_error xtrack_error".split(), 0.0)
    bearings = integers(r, "nav_bearing target_bearing", -180, 360)
    return {**floats(r, "nav_roll", -90, 90), **bearings, "wp_dist": r.randint(0, 5000), **others}


def battery_status(r: random.Random) -> dict[str, Any]:
    others = dict.fromkeys("battery_function type current_consumed energy_consumed".split(), 0)
    values = {"id": maybe(r, 0, 1), "battery_remaining": maybe(r, r.randint(0, 100), -1)}
    return {**others, **values, "temperature": 32767, "voltages": [65535] * 10, "current_battery": -1}


def sys_status(r: random.Random) -> dict[str, Any]:
    sensors = dict.fromkeys((f"onboard_control_sensors_{word}" for word in ("present", "enabled", "health")), 0)
    counts = {f"errors_count{number}": 0 for number in (1, 2, 3, 4)} | {"drop_rate_comm": 0, "errors_comm": 0}
    power = {"voltage_battery": 65535, "current_battery": -1, "battery_remaining": maybe(r, r.randint(0, 100), -1)}
    return {**sensors, **counts, **power, "load": 0}


Batch = dict[str, dict[str, Any]]


def batch(kind: str, r: random.Random) -> Batch:
    """One of each message that a vehicle with these sources sends, in the order of sending.

    What follows from one message only with the help of another, which has become unknown, is left out here: it has
    tests of its own.
    """
    said = {name: globals()[name](r) for name in SOURCES[kind]}
    if not all(math.isfinite(said["attitude"][angle]) for angle in ("roll", "pitch", "yaw")):
        said = {name: values for name, values in said.items() if not name.endswith("_imu")}
    pressure = said.get("scaled_pressure")
    if pressure and not (pressure["press_abs"] > 0 and pressure["temperature"] > ABSOLUTE_ZERO):
        said["vfr_hud"]["airspeed"] = NAN
    return said
