"""Transfers over an emulated serial line, against a model of what such a handshake must take.

Each of N items costs its bytes on the line, 10 ms of processing, and, where a message is lost, the time until the autopilot
asks again: t = N * ((49 + 16) bytes / rate + 10 ms + T * P / (1 - P)), with P = 1 - (1 - p)^2 for a loss p each way, and T
of 1 s for ArduPilot and 250 ms for PX4. Reading back is the same handshake in the other direction, so that an upload that
has been read back is held against twice the model. Parameters come as a list, 37 bytes each, for which the autopilots
take a third of the line; those that are lost are asked for one by one in the model, after the pause of a second that tells
the end of the list.
"""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterator
from pathlib import Path

from figure import Figure

ITEM_BYTES = 49 + 16
PARAMETER_BYTES = 37
REQUEST_BYTES = 32
PROCESSING = 0.010
LIST_PAUSE = 1.0
LIST_SHARE = 3
ASKS_AGAIN = {"ArduPilot": 1.0, "PX4": 0.25}
BITS_PER_BYTE = 10
TARGET = 1.2


def lost(loss: float) -> float:
    """How many more times a pair of messages is needed, on average."""
    pair = 1 - (1 - loss) ** 2
    return pair / (1 - pair)


def mission_model(autopilot: str, items: int, baud: int, loss: float) -> float:
    wire = ITEM_BYTES * BITS_PER_BYTE / baud
    return items * (wire + PROCESSING + ASKS_AGAIN[autopilot] * lost(loss))


def parameter_model(count: int, baud: int, loss: float) -> float:
    byte = BITS_PER_BYTE / baud
    single = (REQUEST_BYTES + PARAMETER_BYTES) * byte + PROCESSING + LIST_PAUSE * lost(loss)
    return count * PARAMETER_BYTES * byte * LIST_SHARE + LIST_PAUSE + count * loss * single


def model(case: str) -> float:
    autopilot, *numbers = case.removesuffix(" read back").removesuffix(" %").split()
    if numbers[0] == "parameters":
        return parameter_model(int(numbers[1]), int(numbers[2]), int(numbers[3]) / 100)
    handshakes = 2 if case.endswith(" read back") else 1
    return handshakes * mission_model(autopilot, int(numbers[0]), int(numbers[1]), int(numbers[2]) / 100)


def figures(programs: Path) -> Iterator[Figure]:
    process = subprocess.Popen([programs / "bench_upload"], stdout=subprocess.PIPE, text=True)
    assert process.stdout
    for line in process.stdout:
        measured = json.loads(line)
        case = measured["case"]
        yield Figure("upload", case, measured["value"], "s", "model", model(case), target=TARGET, of_ratio=True)
    if process.wait() != 0:
        raise SystemExit(f"bench_upload ended with status {process.returncode}")
