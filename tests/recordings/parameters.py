"""Writes the parameters that a recorded autopilot listed, as rows of the simulator's tables.

    python tests/recordings/parameters.py ../shared/recordings/ap_params_v2.tlog.gz >src/ponte/sim/arducopter_parameters.def
"""

from __future__ import annotations

import struct
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).parent.parent / "independent"))

import mavlink_frames
import tlog

TYPES = {2: "int8", 4: "int16", 6: "int32", 9: "real32"}
PX4 = 12


def messages(path: Path) -> Iterator[Any]:
    for record in tlog.read_records(path):
        frame = mavlink_frames.parse(record.frame)
        if frame.system == 1:
            yield mavlink_frames.decode(frame)


def shortest(value: float) -> str:
    """The shortest text that is the same float."""
    single = struct.pack("<f", value)
    rounded = (float(f"{value:.{digits}g}") for digits in range(1, 10))
    return repr(next(each for each in rounded if struct.pack("<f", each) == single)).removesuffix(".0")


def rows(path: Path) -> Iterator[str]:
    """Each parameter as it was listed first, by index."""
    bitwise = False  # PX4 sends the bits of an integer
    listed: dict[int, Any] = {}
    for message in messages(path):
        if message.get_type() == "HEARTBEAT":
            bitwise = message.autopilot == PX4
        elif message.get_type() == "PARAM_VALUE" and message.param_index < message.param_count:
            listed.setdefault(message.param_index, message)
    assert len(listed) == listed[0].param_count, "some are missing"
    for index in sorted(listed):
        value, kind = listed[index].param_value, TYPES[listed[index].param_type]
        if kind == "real32":
            text = shortest(value)
        else:
            text = str(struct.unpack("<i", struct.pack("<f", value))[0] if bitwise else int(value))
        yield f'{{"{listed[index].param_id}", {kind}, {text}}},'


print(*rows(Path(sys.argv[1])), sep="\n")
