"""Ponte's DLI encoder against the independent reader: every message of both editions, with extremes and gaps."""

from __future__ import annotations

import math
import struct
from collections import defaultdict
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from dli_fields import Value
from dli_reader import DliError, Message, decode_datagram, identifier_text
from dli_tables import EDITIONS, Field, tables
from programs import json_objects, seed_or

DEFAULT_SEED = 4586
INSTANCES = 40
MESSAGES_SHOWN = 30
VALUE_TOLERANCE = 1e-9
SEQUENCE_FIELD = {"3": {0xFFFF}, "A": {0, 1}}
FLOAT_NAMES = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}

Instance = dict[str, Any]


@cache
def instances(probe: Path, edition: str, seed: int) -> list[Instance]:
    """What the probe prints for one edition."""
    return list(json_objects([probe, "--seed", str(seed), "--count", str(INSTANCES), "--edition", edition]))


@pytest.fixture(params=EDITIONS)
def edition(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture
def printed(probe: Callable[[str], Path], edition: str) -> list[Instance]:
    return instances(probe("ponte_dli_probe"), edition, seed_or(DEFAULT_SEED))


def as_float32(value: Any) -> bytes:
    """The four bytes of a float given in JSON; all NaNs are one."""
    number = FLOAT_NAMES[value] if isinstance(value, str) else float(value)
    return struct.pack(">f", math.nan if math.isnan(number) else number)


def raw_agrees(field: Field, said: Any, read: Value) -> bool:
    """Whether the raw value that the probe names is the one in the bytes."""
    if field.kind == "f":
        return not isinstance(said, bool) and as_float32(said) == as_float32(read.raw)
    if field.kind == "c":
        return isinstance(said, str) and said == read.raw
    return isinstance(said, int) and not isinstance(said, bool) and said == read.raw


def value_finding(field: Field, said: dict[str, Any], read: Value) -> str | None:
    """A value belongs to every field whose scale is known, and to no other."""
    if (read.value is None) != (said.get("value") is None):
        return f"field {field.number}: value {said.get('value')!r}, the table gives {read.value!r}"
    if read.value is None or math.isclose(said["value"], read.value, rel_tol=VALUE_TOLERANCE, abs_tol=0.0):
        return None
    return f"field {field.number}: value {said['value']!r} instead of {read.value!r}"


def field_findings(message: Message, said: dict[str, dict[str, Any]]) -> list[str]:
    """What is wrong with the fields."""
    if {int(number) for number in said} != set(message.fields):
        return [f"says fields {sorted(map(int, said))}, the bytes hold {sorted(message.fields)}"]
    found: list[str] = []
    for number, read in message.fields.items():
        told = said[str(number)]
        if not raw_agrees(read.field, told.get("raw"), read):
            found.append(f"field {number}: raw {told.get('raw')!r}, the bytes hold {read.raw!r}")
        if finding := value_finding(read.field, told, read):
            found.append(finding)
        if read.field.kind == "c" and read.field.width and (not read.padding or any(read.padding)):
            found.append(f"field {number}: the text ends in {read.padding!r} instead of NULs")
        if read.field.laser:
            found.append(f"field {number}: {read.field.name} is never to be sent")
    return found


def wrapper_findings(message: Message, edition: str, instance: Instance) -> list[str]:
    """What is wrong with the wrapper."""
    wrapped = message.wrapped
    read = {
        "number": wrapped.number,
        "edition": message.edition,
        "source": identifier_text(wrapped.source),
        "destination": identifier_text(wrapped.destination),
        "ack": wrapped.acknowledge,
        "checksum": wrapped.checksum_size,
    }
    wrong = {key: value for key, value in read.items() if instance.get(key) != value}
    found = [f"{key} is said to be {instance.get(key)!r}, is {value!r}" for key, value in wrong.items()]
    if wrapped.sequence not in SEQUENCE_FIELD[edition]:
        found.append(f"the first field of the wrapper holds {wrapped.sequence:04X}")
    if wrapped.reserved_bits:
        found.append(f"reserved bits are set: {wrapped.reserved_bits:06b}")
    return found


def findings(edition: str, instance: Instance) -> list[str]:
    """All that is wrong with one instance."""
    try:
        messages = decode_datagram(bytes.fromhex(instance["hex"]))
    except (DliError, ValueError) as error:
        return [f"{type(error).__name__}: {error}"]
    if len(messages) != 1:
        return [f"{len(messages)} messages instead of one"]
    (message,) = messages
    unknown = [f"vector bits without a field: {message.unknown_bits:b}"] if message.unknown_bits else []
    return wrapper_findings(message, edition, instance) + unknown + field_findings(message, instance["fields"])


def test_every_message_of_the_edition_is_printed(printed: list[Instance], edition: str) -> None:
    assert {instance["number"] for instance in printed} == set(tables(edition))


def test_the_bytes_hold_what_the_probe_says(printed: list[Instance], edition: str) -> None:
    wrong: defaultdict[int, list[str]] = defaultdict(list)
    for instance in printed:
        if found := findings(edition, instance):
            wrong[instance["number"]].append(f"{'; '.join(found)[:400]} [{instance['hex']}]")
    lines = [f"{number}: {len(found)} times, first: {found[0]}" for number, found in sorted(wrong.items())]
    head = f"{len(wrong)} messages differ, PONTE_SEED={seed_or(DEFAULT_SEED)}"
    assert not wrong, "\n".join([head, *lines[:MESSAGES_SHOWN]])


def test_every_message_comes_as_often_as_asked(printed: list[Instance]) -> None:
    counts: defaultdict[int, int] = defaultdict(int)
    for instance in printed:
        counts[instance["number"]] += 1
    assert set(counts.values()) == {INSTANCES}


def test_presence_runs_from_the_time_alone_to_everything(printed: list[Instance], edition: str) -> None:
    """Everything means every field that Ponte sends, so without laser and designator fields."""
    seen: defaultdict[int, set[frozenset[int]]] = defaultdict(set)
    for instance in printed:
        seen[instance["number"]].add(frozenset(int(number) for number in instance["fields"]))
    lacking = []
    for number, table in tables(edition).items():
        everything = frozenset(field.number for field in table.fields.values() if not field.laser)
        if not {frozenset({1}), everything} <= seen[number]:
            lacking.append(number)
    assert lacking == []


def test_raw_values_reach_both_ends_of_every_type(printed: list[Instance], edition: str) -> None:
    reached: defaultdict[tuple[str, int], set[int]] = defaultdict(set)
    for instance in printed:
        fields = tables(edition)[instance["number"]].fields
        for number, said in instance["fields"].items():
            field = fields.get(int(number))
            if field and field.raw_range:
                reached[field.kind, field.width] |= {said["raw"]} & set(field.raw_range)
    kinds = {(f.kind, f.width): f.raw_range for t in tables(edition).values() for f in t.fields.values() if f.raw_range}
    assert {kind: set(ends) - reached[kind] for kind, ends in kinds.items() if set(ends) - reached[kind]} == {}


def test_checksums_and_acknowledgements_of_every_kind_come(printed: list[Instance]) -> None:
    assert {instance["checksum"] for instance in printed} == {0, 2, 4}
    assert {instance["ack"] for instance in printed} == {False, True}


def test_the_same_seed_gives_the_same_bytes(probe: Callable[[str], Path], edition: str) -> None:
    command = [probe("ponte_dli_probe"), "--count", "3", "--edition", edition, "--seed"]
    first, again, other = (list(json_objects([*command, seed])) for seed in ("77", "77", "78"))
    assert first == again
    assert first != other
