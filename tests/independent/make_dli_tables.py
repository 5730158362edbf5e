"""Makes dli_tables.json, the facts the independent reader works from.

Usage: python make_dli_tables.py path/to/messages.toml [output.json]

The table is committed, because tests run without the source document. It holds facts only: numbers, widths, types,
scales and units. Weapons messages are left out altogether, and so are two numbers that stand for a whole block.
Laser and designator fields stay, since a reader has to step over them, and carry the flag `laser`: Ponte never sends
them.
"""

from __future__ import annotations

import json
import sys
import tomllib
from pathlib import Path
from typing import Any

WEAPONS = {24000, 26000}
BLOCK_PLACEHOLDERS = {30000, 42000}
LASER_WORDS = ("laser", "designator")


def field_facts(field: dict[str, Any]) -> dict[str, Any]:
    """The facts of one field; keys that say nothing are left out."""
    facts: dict[str, Any] = {"n": field["n"], "name": field["name"], "type": field["type"]}
    for key in ("scale", "unit", "only"):
        if key in field:
            facts[key] = field[key]
    if any(word in field["name"].lower() for word in LASER_WORDS):
        facts["laser"] = True
    return facts


def message_facts(message: dict[str, Any]) -> dict[str, Any]:
    """The facts of one message. A message whose fields are not known has an empty list and no vector width."""
    return {
        "number": message["number"],
        "name": message.get("name_ed3") or message["name_edA"],
        "editions": message["editions"],
        "pv": message.get("pv", {}),
        "fields": [field_facts(field) for field in message.get("fields", [])],
    }


def render(messages: list[dict[str, Any]]) -> str:
    """JSON with one field a line, so that a change of one fact is a change of one line."""
    blocks: list[str] = []
    for message in messages:
        head = {key: value for key, value in message.items() if key != "fields"}
        fields = ",\n".join("   " + json.dumps(field) for field in message["fields"])
        body = f"[\n{fields}\n  ]" if fields else "[]"
        blocks.append(f" {json.dumps(head)[:-1]},\n  \"fields\": {body}}}")
    return '{"messages": [\n' + ",\n".join(blocks) + "\n]}\n"


def main(arguments: list[str]) -> int:
    if len(arguments) not in (1, 2):
        print(__doc__, file=sys.stderr)
        return 2
    output = Path(arguments[1]) if len(arguments) == 2 else Path(__file__).with_name("dli_tables.json")
    source = tomllib.loads(Path(arguments[0]).read_text(encoding="utf-8"))
    left_out = WEAPONS | BLOCK_PLACEHOLDERS
    messages = [message_facts(m) for m in source["message"] if m["number"] not in left_out]
    output.write_text(render(sorted(messages, key=lambda m: m["number"])), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
