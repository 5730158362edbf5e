"""The facts table is whole and consistent, and its maker renders what is committed."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest

from dli_tables import EDITIONS, tables
from make_dli_tables import BLOCK_PLACEHOLDERS, WEAPONS, main, render

TABLE_FILE = Path(__file__).with_name("dli_tables.json")
SOURCE = Path(__file__).resolve().parents[3] / "shared" / "stanag4586" / "messages.toml"

# The one source of this message gives it a byte more than its sixteen fields need.
WIDER_THAN_NEEDED = {(5, "A")}


@pytest.mark.parametrize("edition", EDITIONS)
def test_every_vector_is_as_wide_as_its_fields_need(edition: str) -> None:
    wrong = [
        number
        for number, table in tables(edition).items()
        if table.vector_width != math.ceil(max(table.fields) / 8) + ((number, edition) in WIDER_THAN_NEEDED)
    ]
    assert wrong == []


@pytest.mark.parametrize("edition", EDITIONS)
def test_every_message_begins_with_a_time_stamp(edition: str) -> None:
    firsts = {(t.fields[1].name, t.fields[1].kind, t.fields[1].width) for t in tables(edition).values()}
    assert firsts == {("Time Stamp", "u", 5)}


def test_no_weapons_message_and_no_block_is_in_the_file() -> None:
    numbers = {message["number"] for message in json.loads(TABLE_FILE.read_text())["messages"]}
    assert not numbers & (WEAPONS | BLOCK_PLACEHOLDERS)
    assert 4000 in numbers


@pytest.mark.parametrize("edition", EDITIONS)
def test_laser_fields_are_flagged_and_only_in_two_messages(edition: str) -> None:
    flagged = {n: [f.number for f in t.fields.values() if f.laser] for n, t in tables(edition).items()}
    assert {n: fields for n, fields in flagged.items() if fields} == {19001: [11, 12, 13, 14], 21002: [22, 23, 24, 25]}


def test_alert_grows_by_three_fields_in_edition_a() -> None:
    assert set(tables("A")[16000].fields) - set(tables("3")[16000].fields) == {15, 16, 17}


def test_the_file_is_rendered_the_same_again() -> None:
    text = TABLE_FILE.read_text(encoding="utf-8")
    assert render(json.loads(text)["messages"]) == text


@pytest.mark.skipif(not SOURCE.exists(), reason=f"no source document at {SOURCE}")
def test_the_file_is_what_the_source_document_says(tmp_path: Path) -> None:
    made = tmp_path / "made.json"
    assert main([str(SOURCE), str(made)]) == 0
    assert made.read_text(encoding="utf-8") == TABLE_FILE.read_text(encoding="utf-8")
