"""Cuts the dialogues of this folder's `dialogues` out of the large shared recordings, and counts rates.

Usage: python dialogues.py path/to/shared/recordings

A dialogue keeps all that the ground station says, and of the vehicle each HEARTBEAT, the answers, the items reached,
and the first frame of each type. rates.json says how often each message came in some stretches of the recordings,
which begin and end with a HEARTBEAT of the vehicle.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "independent"))

import conduct  # noqa: E402
import mavlink_frames  # noqa: E402
import tlog  # noqa: E402

DIALOGUES = (
    "ap_rest_v2", "ap_mission_v2", "ap_params_v2", "ap_protocol_v2", "plane_mission_v2",
    "px4_rest_v2", "px4_mission_v2", "px4_params_v2",
)  # fmt: skip
STRETCHES = {
    "ap_rest_v2": {"silent station": (5, 18), "streams": (45, 52), "intervals": (57, 67)},
    "ap_mission_v2": {"in flight": (90, 150)},
    "plane_mission_v2": {"in flight": (90, 150)},
    "px4_rest_v2": {"at rest": (14, 34), "intervals": (39, 50)},
    "px4_mission_v2": {"in flight": (60, 120)},
}


def stays(frame: mavlink_frames.Frame, met: set[int], asked: set[str]) -> bool:
    parameter = conduct.parameter_of(frame)
    if frame.system != conduct.VEHICLE:
        asked |= {parameter} if parameter else set()
        return True
    is_new = frame.message_id not in met
    met.add(frame.message_id)
    is_kept = conduct.is_heartbeat(frame) or conduct.is_answer(frame) or conduct.name_of(frame) == "MISSION_ITEM_REACHED"
    return is_new or is_kept or parameter in asked


def dialogue(path: Path) -> Iterator[tuple[int, bytes]]:
    """The records of a recording that stay."""
    met: set[int] = set()
    asked: set[str] = set()
    for record in tlog.read_records(path):
        if stays(mavlink_frames.parse(record.frame), met, asked):
            yield record.time_us, record.frame


def stretches(source: Path) -> Iterator[dict[str, object]]:
    for name, phases in STRETCHES.items():
        frames = [mavlink_frames.parse(record.frame) for record in tlog.read_records(source / f"{name}.tlog.gz")]
        for phase, (first, last) in phases.items():
            per_second = conduct.rates_between(frames, first, last)
            yield {"recording": name, "phase": phase, "first": first, "last": last, "per_second": per_second}


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    source, target = Path(arguments[0]), Path(__file__).parent / "dialogues"
    target.mkdir(exist_ok=True)
    for name in DIALOGUES:
        tlog.write_log(target / f"{name}.tlog.gz", dialogue(source / f"{name}.tlog.gz"))
    (target / "rates.json").write_text(json.dumps(list(stretches(source)), indent=1) + "\n")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
