"""Values of MAVLink messages: seeded samples, and the JSON form in which probes take and give them."""

from __future__ import annotations

import math
import random
import string
import struct
from collections.abc import Iterator
from typing import Any, NamedTuple

Scalar = int | float | bytes
Values = dict[str, Scalar | list[Scalar]]

INTEGER_RANGES = {
    f"{'u' if low == 0 else ''}int{bits}_t": (low, high)
    for bits in (8, 16, 32, 64)
    for low, high in ((0, 2**bits - 1), (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1))
}
PRINTABLE = string.digits + string.ascii_letters + string.punctuation + " "
FLOAT_MAX = struct.unpack("<f", b"\xff\xff\x7f\x7f")[0]
FLOAT_TINY = struct.unpack("<f", b"\x01\x00\x00\x00")[0]
DOUBLE_MAX = struct.unpack("<d", b"\xff\xff\xff\xff\xff\xff\xef\x7f")[0]
DOUBLE_TINY = struct.unpack("<d", b"\x01\x00\x00\x00\x00\x00\x00\x00")[0]


class Slot(NamedTuple):
    """One field of a message as its definition has it; `count` is 0 for a single value."""

    name: str
    kind: str
    count: int
    wire_position: int


def slots(message_class: Any) -> list[Slot]:
    """The fields of a pymavlink message class in the order of its definition."""
    positions = [message_class.ordered_fieldnames.index(name) for name in message_class.fieldnames]
    return [
        Slot(name, kind, message_class.array_lengths[position], position)
        for name, kind, position in zip(message_class.fieldnames, message_class.fieldtypes, positions)
    ]


def float32(value: float) -> float:
    """The nearest value that four bytes can hold."""
    return struct.unpack("<f", struct.pack("<f", value))[0]


def edge_values(kind: str) -> dict[str, int | float]:
    """The named edges of a type; for integers the names of float edges fall back to zero or the ends."""
    if kind in INTEGER_RANGES:
        low, high = INTEGER_RANGES[kind]
        return {"zero": 0, "min": low, "max": high, "nan": high, "inf": high, "-inf": low, "-0": 0, "tiny": 1}
    top, tiny = (FLOAT_MAX, FLOAT_TINY) if kind == "float" else (DOUBLE_MAX, DOUBLE_TINY)
    return {
        "zero": 0.0, "min": -top, "max": top, "nan": math.nan, "inf": math.inf, "-inf": -math.inf, "-0": -0.0, "tiny": tiny,
    }  # fmt: skip


def random_scalar(source: random.Random, kind: str) -> int | float:
    """A value of any size, an edge in one case of four."""
    if source.random() < 0.25:
        return source.choice(list(edge_values(kind).values()))
    if kind in INTEGER_RANGES:
        low, high = INTEGER_RANGES[kind]
        return source.randint(low, high)
    value = source.uniform(-1.0, 1.0) * 10.0 ** source.randint(-6, 12)
    return float32(value) if kind == "float" else value


def random_text(source: random.Random, size: int) -> bytes:
    return "".join(source.choice(PRINTABLE) for _ in range(size)).encode("ascii")


def edge_sample(message_class: Any, edge: str) -> Values:
    """All fields at one named edge. Text is empty at `zero` and `min`, and full everywhere else."""
    sample: Values = {}
    for slot in slots(message_class):
        if slot.kind == "char":
            sample[slot.name] = b"" if edge in ("zero", "min") else b"~" * max(slot.count, 1)
        else:
            value = edge_values(slot.kind)[edge]
            sample[slot.name] = [value] * slot.count if slot.count else value
    return sample


def random_sample(message_class: Any, source: random.Random, zero_tail: int = 0) -> Values:
    """Random values; the last `zero_tail` fields on the wire are zero, so that MAVLink 2 cuts them off."""
    first_zero = len(message_class.fieldnames) - zero_tail
    sample: Values = {}
    for slot in slots(message_class):
        zero = slot.wire_position >= first_zero
        if slot.kind == "char":
            size = 0 if zero else source.choice((0, max(slot.count, 1), source.randint(0, max(slot.count, 1))))
            sample[slot.name] = random_text(source, size)
        elif slot.count:
            filled = 0 if zero else source.choice((0, slot.count, slot.count, source.randint(0, slot.count)))
            content: list[Scalar] = [random_scalar(source, slot.kind) for _ in range(filled)]
            sample[slot.name] = content + [edge_values(slot.kind)["zero"]] * (slot.count - filled)
        else:
            sample[slot.name] = edge_values(slot.kind)["zero"] if zero else random_scalar(source, slot.kind)
    return sample


def samples(message_class: Any, source: random.Random, random_count: int) -> Iterator[Values]:
    """All edges, and then at least `random_count` random samples with zero tails of every length among them."""
    for edge in edge_values("float"):
        yield edge_sample(message_class, edge)
    fields = len(message_class.fieldnames)
    for tail in range(1, fields):
        yield random_sample(message_class, source, tail)
    for _ in range(random_count):
        yield random_sample(message_class, source)


def scalar_to_json(kind: str, value: Scalar) -> Any:
    """One value in the form of the probe: 64 bits as digits in a string, and names for what JSON numbers cannot hold."""
    if isinstance(value, float):
        if math.isnan(value):
            return "NaN"
        if math.isinf(value):
            return "Infinity" if value > 0 else "-Infinity"
        return value
    return str(value) if kind.endswith("int64_t") else value


def to_json(message_class: Any, sample: Values) -> dict[str, Any]:
    """The fields of a sample in the form of the probe."""
    fields: dict[str, Any] = {}
    for slot in slots(message_class):
        value = sample[slot.name]
        if isinstance(value, bytes):
            fields[slot.name] = value.decode("ascii")
        elif isinstance(value, list):
            fields[slot.name] = [scalar_to_json(slot.kind, item) for item in value]
        else:
            fields[slot.name] = scalar_to_json(slot.kind, value)
    return fields


def scalar_bits(kind: str, value: Any) -> bytes | int:
    """What identifies a value given in the form of the probe: the integer, or the bytes of the float."""
    if isinstance(value, bool):
        raise ValueError("true and false are no numbers")
    if kind in INTEGER_RANGES:
        if isinstance(value, str) and kind.endswith("int64_t"):
            return int(value)
        if not isinstance(value, int):
            raise ValueError(f"{value!r} is no {kind}")
        return value
    if isinstance(value, str) and value not in ("NaN", "Infinity", "-Infinity"):
        raise ValueError(f"{value!r} is no {kind}")
    number = float(value)
    return struct.pack("<f" if kind == "float" else "<d", math.nan if math.isnan(number) else number)


def differences(message_class: Any, sample: Values, answer: dict[str, Any]) -> list[str]:
    """How the fields in an answer differ from the sample. Fields that pymavlink does not know must be zero or empty."""
    found: list[str] = []
    wanted = to_json(message_class, sample)
    for slot in slots(message_class):
        got = answer.get(slot.name)
        if got is None:
            found.append(f"{slot.name} is missing")
        elif not same(slot, wanted[slot.name], got):
            found.append(f"{slot.name} is {got!r} instead of {wanted[slot.name]!r}")
    for name in answer.keys() - wanted.keys():
        if not is_zero(answer[name]):
            found.append(f"{name}, which pymavlink does not know, is {answer[name]!r}")
    return found


def same(slot: Slot, wanted: Any, got: Any) -> bool:
    """Whether an answer holds exactly the wanted value."""
    if slot.kind == "char":
        return got == wanted
    if isinstance(wanted, list) != isinstance(got, list):
        return False
    many_wanted, many_got = (wanted, got) if isinstance(wanted, list) else ([wanted], [got])
    if len(many_wanted) != len(many_got):
        return False
    try:
        return all(scalar_bits(slot.kind, w) == scalar_bits(slot.kind, g) for w, g in zip(many_wanted, many_got))
    except (ValueError, TypeError, OverflowError):
        return False


def is_zero(value: Any) -> bool:
    """Whether a value in the form of the probe is zero, an empty text, or a list of such values."""
    if isinstance(value, list):
        return all(is_zero(item) for item in value)
    return value in (0, "0", "")
