"""`ponte sim` before the ground stations of the recordings: what it does otherwise than the real autopilots did.

The differences that remain are known: sim_differences has them, one table for each recording. A difference that is new,
or gone, fails the test; if it is meant, PONTE_UPDATE_GOLDEN=1 writes the table anew.
"""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable
from itertools import pairwise
from pathlib import Path

import conduct
import mavlink_frames
import pytest
import tlog
from recorded_station import play
from recordings_found import OWN_FOLDER

FOLDER = OWN_FOLDER / "dialogues"
TABLES = Path(__file__).parent / "sim_differences"
OPTIONS = {"ap": ("--autopilot", "ardupilot"), "plane": ("--type", "plane"), "px4": ("--autopilot", "px4")}
RECORDINGS = sorted(path.name.removesuffix(".tlog.gz") for path in FOLDER.glob("*.tlog.gz"))
SPEEDUP = "10"
# Where the station acts before the vehicle is ready, it needs time to do so.
SLOWER = {"ap_mission_v2": "5", "ap_protocol_v2": "2", "px4_mission_v2": "5"}
STRETCHES = json.loads((FOLDER / "rates.json").read_text())


def table(name: str, differences: Iterable[conduct.Difference]) -> str:
    rows = [f"\n{what}\n  recorded   {before}\n  simulated  {now}\n" for what, before, now in differences]
    return f"{name}: {len(rows)} differences\n" + "".join(rows)


def sequence_is_whole(frames: Iterable[mavlink_frames.Frame]) -> bool:
    """Nothing was lost, and the vehicle started anew at most."""
    numbers = [frame.sequence for frame in frames if frame.system == conduct.VEHICLE]
    return all(later in ((earlier + 1) % 256, 0) for earlier, later in pairwise(numbers))


def test_there_is_a_recording_of_each_personality() -> None:
    assert {name.split("_")[0] for name in RECORDINGS} == set(OPTIONS)


@pytest.mark.once
@pytest.mark.parametrize("name", RECORDINGS)
def test_it_differs_from_the_real_one_only_as_is_known(
    start_ponte: Callable[..., None], capsys: pytest.CaptureFixture[str], name: str
) -> None:
    recorded = [mavlink_frames.parse(record.frame) for record in tlog.read_records(FOLDER / f"{name}.tlog.gz")]
    played = play(recorded, start_ponte, *OPTIONS[name.split("_")[0]], "--speedup", SLOWER.get(name, SPEEDUP))
    assert sequence_is_whole(played)
    before, now = conduct.conduct_of(recorded), conduct.conduct_of(played)
    differences = list(conduct.compare(before, now))
    for stretch in (each for each in STRETCHES if each["recording"] == name):
        first, last = stretch["first"], stretch["last"]
        rates = conduct.rates_between(played, first, last)
        of_both = before.types & now.types
        for what, *values in conduct.compare_rates(stretch["per_second"], rates, last - first, of_both):
            differences.append((f"{stretch['phase']}: {what}", *values))
    text = table(name, differences)
    with capsys.disabled():
        print(f"\n{text}")
    expected = TABLES / f"{name}.txt"
    if "PONTE_UPDATE_GOLDEN" in os.environ:
        expected.write_text(text)
    assert text == expected.read_text()
