"""The message tables of DLI Edition 3 and A, read from dli_tables.json."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import cache
from pathlib import Path

EDITIONS = ("3", "A")


@dataclass(frozen=True)
class Field:
    """One field of a message. `kind` is u, i, b, f or c; `width` is in bytes and 0 for text of variable length."""

    number: int
    name: str
    kind: str
    width: int
    scale: float | None
    unit: str | None
    laser: bool

    @property
    def factor(self) -> float | None:
        """What one raw unit is worth, or nothing where the scale is not known."""
        if self.kind == "b":
            return math.pi / 2 ** (8 * self.width - 1)
        return self.scale

    @property
    def raw_range(self) -> tuple[int, int] | None:
        """The smallest and the greatest raw integer, or nothing for text and floats."""
        if self.kind == "u":
            return 0, 2 ** (8 * self.width) - 1
        if self.kind in "ib":
            return -(2 ** (8 * self.width - 1)), 2 ** (8 * self.width - 1) - 1
        return None


@dataclass(frozen=True)
class Table:
    """One message in one edition: the width of its presence vector and its fields by number."""

    number: int
    name: str
    edition: str
    vector_width: int
    fields: dict[int, Field]


def _field(entry: dict) -> Field:
    kind, digits = entry["type"][0], entry["type"][1:]
    scale = entry.get("scale")
    return Field(
        number=entry["n"],
        name=entry["name"],
        kind=kind,
        width=int(digits) if digits else 0,
        scale=None if scale is None else float(scale),
        unit=entry.get("unit"),
        laser=entry.get("laser", False),
    )


@cache
def tables(edition: str) -> dict[int, Table]:
    """All messages of `edition` whose fields are known, by message number."""
    if edition not in EDITIONS:
        raise ValueError(f"no tables for edition {edition!r}")
    source = json.loads(Path(__file__).with_name("dli_tables.json").read_text(encoding="utf-8"))
    found: dict[int, Table] = {}
    for message in source["messages"]:
        if edition not in message["editions"] or edition not in message["pv"]:
            continue
        entries = [f for f in message["fields"] if f.get("only", edition) == edition]
        found[message["number"]] = Table(
            number=message["number"],
            name=message["name"],
            edition=edition,
            vector_width=message["pv"][edition],
            fields={entry["n"]: _field(entry) for entry in entries},
        )
    return found
