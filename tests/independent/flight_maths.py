"""What #4000 Inertial States must hold for given MAVLink values, calculated apart from Ponte.

Field numbers of #4000: 2 latitude, 3 longitude, 4 altitude, 5 altitude type, 6 to 8 speeds north, east and down,
12 roll, 13 pitch, 14 heading, 15 roll rate, 16 pitch rate, 17 turn rate. Results are raw integers as on the wire.
"""

from __future__ import annotations

import math
from fractions import Fraction

ALTITUDE_TYPE_WGS84 = 3
ALTITUDE_TYPE_BARO = 1
RATE_UNIT = 0.005  # rad/s

# The documents leave the rates absent "near" a pitch of 90 degrees and give no limit. Up to the first angle they must
# be sent, from the second on they must not be, and between the two either is right.
RATES_SURE_BELOW = math.radians(80.0)
RATES_ABSENT_FROM = math.radians(89.9)

LIMITS = {2: 2**15, 3: 2**23, 4: 2**31}


def round_half_away(value: float | Fraction) -> int:
    """Rounds to the nearest integer; halves go away from zero."""
    return int(math.floor(abs(value) + Fraction(1, 2))) * (1 if value >= 0 else -1)


def wrap_signed(raw: int, octets: int) -> int:
    """Brings a raw angle into the range of a signed integer, as a full turn is 2^(8 * octets)."""
    half = 1 << (8 * octets - 1)
    return (raw + half) % (2 * half) - half


def bam2(radians: float) -> int:
    """A two byte binary angle."""
    return wrap_signed(round_half_away(radians * 32768 / math.pi), 2)


def bam4_from_deg_e7(deg_e7: int) -> int:
    """A four byte binary angle from degrees times 10^7, without leaving integers."""
    return wrap_signed(round_half_away(Fraction(deg_e7 * 2**32, 3_600_000_000)), 4)


def scaled(value: float | Fraction, unit: float | Fraction, octets: int) -> int | None:
    """A scaled signed integer, or nothing where the value does not fit or is not a number."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    raw = round_half_away(value / unit)
    return raw if -LIMITS[octets] <= raw < LIMITS[octets] else None


def euler_rates(
    roll: float, pitch: float, body_rates: tuple[float, float, float]
) -> tuple[float, float, float] | None:
    """Roll, pitch and turn rate from the rates about the body's axes; nothing where the turn rate loses its meaning."""
    if abs(pitch) >= RATES_ABSENT_FROM:
        return None
    p, q, r = body_rates
    across = q * math.sin(roll) + r * math.cos(roll)
    return p + math.tan(pitch) * across, q * math.cos(roll) - r * math.sin(roll), across / math.cos(pitch)


def attitude_fields(
    roll: float, pitch: float, yaw: float, rollspeed: float, pitchspeed: float, yawspeed: float
) -> dict[int, int]:
    """Fields 12 to 17 from an ATTITUDE. A field that must be absent is missing."""
    fields = {number: bam2(angle) for number, angle in ((12, roll), (13, pitch), (14, yaw)) if math.isfinite(angle)}
    if math.isfinite(roll) and math.isfinite(pitch):
        rates = euler_rates(roll, pitch, (rollspeed, pitchspeed, yawspeed)) or ()
        for number, rate in zip((15, 16, 17), rates):
            raw = scaled(rate, RATE_UNIT, 2)
            if raw is not None:
                fields[number] = raw
    return fields


def position_fields(lat: int, lon: int, alt: int, vx: int, vy: int, vz: int) -> dict[int, int]:
    """Fields 2 to 8 from a GLOBAL_POSITION_INT, for altitude type 3. A field that does not fit is missing."""
    fields: dict[int, int | None] = {
        2: bam4_from_deg_e7(lat),
        3: bam4_from_deg_e7(lon),
        4: scaled(Fraction(alt), Fraction(20), 3),
        5: ALTITUDE_TYPE_WGS84,
        6: scaled(Fraction(vx), Fraction(5), 2),
        7: scaled(Fraction(vy), Fraction(5), 2),
        8: scaled(Fraction(vz), Fraction(5), 2),
    }
    return {number: raw for number, raw in fields.items() if raw is not None}


def angle_difference(one: int, other: int, octets: int) -> int:
    """How far two raw angles are apart, the shorter way round."""
    return abs(wrap_signed(one - other, octets))
