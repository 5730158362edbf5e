"""What an autopilot did before a ground station, as facts that two of its kind can be compared by.

A dialogue is every frame of both sides in order. Its clock is the vehicle's HEARTBEAT, of which there is one a second
of the vehicle's own time, so that it does not matter how fast that time ran.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import Any, NamedTuple

import mavlink_frames
from mavlink_frames import Frame

VEHICLE = 1
HEARTBEAT = 0
ARMED = 128  # of base_mode
RATE_MARGIN = 0.1  # of a rate, that may differ

# What pymavlink has no definition of.
NAMES_OF_OTHERS = {
    8: "LINK_NODE_STATUS", 290: "ESC_INFO", 291: "ESC_STATUS", 300: "PROTOCOL_VERSION", 380: "TIME_ESTIMATE_TO_TARGET",
    410: "EVENT", 411: "CURRENT_EVENT_SEQUENCE", 441: "GNSS_INTEGRITY", 514: "ESTIMATOR_SENSOR_FUSION_STATUS",
}  # fmt: skip
ANSWERS = {
    "COMMAND_ACK", "MISSION_ACK", "MISSION_COUNT", "MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ITEM",
    "MISSION_ITEM_INT",
}  # fmt: skip
# What comes when something happens has no rate.
OCCASIONAL = ANSWERS | {"EVENT", "MISSION_ITEM_REACHED", "PARAM_VALUE", "STATUSTEXT"}
SIGNS_OF_POSITION = ("GPS_GLOBAL_ORIGIN", "HOME_POSITION", "LOCAL_POSITION_NED")

Difference = tuple[str, str, str]
"""What differs, as it was recorded, as it is simulated."""


def name_of(frame: Frame) -> str:
    known = mavlink_frames.dialect.mavlink_map.get(frame.message_id)
    return known.msgname if known else NAMES_OF_OTHERS.get(frame.message_id, f"message {frame.message_id}")


def is_heartbeat(frame: Frame) -> bool:
    return frame.system == VEHICLE and frame.message_id == HEARTBEAT


def is_said(frame: Frame) -> bool:
    """By the station, and not only to show that it is there."""
    return frame.system != VEHICLE and frame.message_id != HEARTBEAT


def is_answer(frame: Frame) -> bool:
    """Of the vehicle to somebody, since PX4 also answers its own commands."""
    return frame.system == VEHICLE and name_of(frame) in ANSWERS and mavlink_frames.decode(frame).target_system != 0


def _enum(name: str, value: int) -> str:
    entry = mavlink_frames.dialect.enums[name].get(value)
    return entry.name.removeprefix(f"{name}_").removeprefix("MAV_") if entry else str(value)


def _number(value: float) -> str:
    return f"{value:.7g}"


def _item(m: Any) -> str:
    values = [m.frame, m.current, m.autocontinue, m.param1, m.param2, m.param3, m.param4]
    place = f"{m.x}, {m.y}" if isinstance(m.x, int) else f"{m.x:.7f}, {m.y:.7f}"
    return f"{m.seq}: {m.command}({', '.join(map(_number, values))}) at {place}, {m.z:.1f}"


def _words(m: Any) -> str:
    """A message in one line, without what says only to whom it goes."""
    kind = m.get_type()
    match kind:
        case "COMMAND_ACK":
            return f"{kind} {m.command} {_enum('MAV_RESULT', m.result)}"
        case "MISSION_ACK":
            return f"{kind} {_enum('MAV_MISSION_RESULT', m.type)}"
        case "MISSION_COUNT":
            return f"{kind} {m.count}"
        case "MISSION_ITEM" | "MISSION_ITEM_INT":
            return f"{kind} {_item(m)}"
        case "COMMAND_LONG":
            values = [m.param1, m.param2, m.param3, m.param4, m.param5, m.param6, m.param7]
            other = "" if m.target_system == VEHICLE else f" to system {m.target_system}"
            return f"{kind} {m.command}({', '.join(map(_number, values))}){other}"
        case "COMMAND_INT":
            return f"{kind} {m.command}"
        case "PARAM_VALUE" | "PARAM_SET":
            return f"{kind} {m.param_id} type {m.param_type}"
        case "PARAM_REQUEST_READ" | "PARAM_ERROR":
            return f"{kind} {m.param_id}"
    return f"{kind} {m.seq}" if hasattr(m, "seq") else kind


def said(frame: Frame) -> str:
    """What a frame of either side says."""
    if not mavlink_frames.checksum_is_right(frame):
        return f"{name_of(frame)} with a wrong checksum"
    return _words(mavlink_frames.decode(frame))


def parameter_of(frame: Frame) -> str | None:
    """The parameter that a frame is about by name."""
    if name_of(frame) not in ("PARAM_SET", "PARAM_REQUEST_READ", "PARAM_VALUE", "PARAM_ERROR"):
        return None
    return str(mavlink_frames.decode(frame).param_id) if mavlink_frames.checksum_is_right(frame) else None


class Turn(NamedTuple):
    """Something that the station said, and what it was answered; the same words again are not counted."""

    question: str
    answers: list[str]


class Conduct(NamedTuple):
    """The facts about one dialogue."""

    turns: list[Turn]
    parameters: dict[str, set[str]]  # what is said about those that the station names, with whatever delay
    life: dict[str, list[str]]
    position_after: dict[str, int]  # seconds until there was a sign of it
    types: set[str]


def turns_of(dialogue: Iterable[Frame]) -> list[Turn]:
    turns: list[Turn] = []
    for frame in dialogue:
        if is_said(frame):
            turns.append(Turn(said(frame), []))
        elif turns and is_answer(frame) and said(frame) not in turns[-1].answers[-1:]:
            turns[-1].answers.append(said(frame))
    return turns


def parameters_of(dialogue: Iterable[Frame]) -> dict[str, set[str]]:
    answers: dict[str, set[str]] = {}
    for frame in dialogue:
        name = parameter_of(frame)
        if name and is_said(frame):
            answers.setdefault(name, set())
        elif name in answers:
            answers[name].add(said(frame))
    return answers


def _changes(values: Iterable[str]) -> list[str]:
    return [value for value, _ in groupby(values)]


def _repeated(values: Iterable[int]) -> Iterator[str]:
    for value, group in groupby(values):
        yield f"{value}, repeated" if len(list(group)) > 1 else str(value)


def life_of(dialogue: Sequence[Frame]) -> dict[str, list[str]]:
    """What the vehicle went through; each by itself, since chance has a part in which of them comes first."""
    states = [mavlink_frames.decode(frame) for frame in dialogue if is_heartbeat(frame)]
    reached = (f for f in dialogue if f.system == VEHICLE and name_of(f) == "MISSION_ITEM_REACHED")
    return {
        "system_status": _changes(_enum("MAV_STATE", m.system_status) for m in states),
        "armed": _changes("armed" if m.base_mode & ARMED else "disarmed" for m in states),
        "custom_mode": _changes(f"{m.custom_mode:#x}" for m in states),
        "base_mode but for armed": sorted({f"{m.base_mode & ~ARMED} in mode {m.custom_mode:#x}" for m in states}),
        "items reached": list(_repeated(mavlink_frames.decode(frame).seq for frame in reached)),
    }


def conduct_of(dialogue: Sequence[Frame]) -> Conduct:
    position_after: dict[str, int] = {}
    seconds = 0
    for frame in dialogue:
        seconds += is_heartbeat(frame)
        if frame.system == VEHICLE and name_of(frame) in SIGNS_OF_POSITION:
            position_after.setdefault(name_of(frame), seconds)
    types = {name_of(frame) for frame in dialogue if frame.system == VEHICLE}
    return Conduct(turns_of(dialogue), parameters_of(dialogue), life_of(dialogue), position_after, types)


def rates_between(dialogue: Iterable[Frame], first: int, last: int) -> dict[str, float]:
    """Messages a second of each type, from the `first` HEARTBEAT of the vehicle to the `last`."""
    counts: Counter[str] = Counter()
    seconds = 0
    for frame in dialogue:
        seconds += is_heartbeat(frame)
        if seconds >= last:
            break
        if seconds >= first and frame.system == VEHICLE:
            counts[name_of(frame)] += 1
    return {name: round(count / (last - first), 2) for name, count in sorted(counts.items())}


def compare_rates(
    recorded: dict[str, float], simulated: dict[str, float], seconds: int, types: set[str]
) -> Iterator[Difference]:
    """Of these types; a message more or less in so many seconds is none."""
    for name in sorted(types - OCCASIONAL):
        before, now = recorded.get(name, 0), simulated.get(name, 0)
        if abs(before - now) > max(RATE_MARGIN * max(before, now), 1.1 / seconds):
            yield f"{name} a second", f"{before:g}", f"{now:g}"


def _joined(words: Iterable[str], by: str) -> str:
    return by.join(words) or "nothing"


def compare(recorded: Conduct, simulated: Conduct) -> Iterator[Difference]:
    assert [turn.question for turn in recorded.turns] == [turn.question for turn in simulated.turns]
    for before, now in zip(recorded.turns, simulated.turns, strict=True):
        if before.answers != now.answers:
            yield before.question, _joined(before.answers, "; "), _joined(now.answers, "; ")
    for name, answers in recorded.parameters.items():
        if answers != simulated.parameters[name]:
            yield f"about {name}", _joined(sorted(answers), "; "), _joined(sorted(simulated.parameters[name]), "; ")
    for name, course in recorded.life.items():
        if course != simulated.life[name]:
            yield name, _joined(course, " > "), _joined(simulated.life[name], " > ")
    for name in SIGNS_OF_POSITION:
        before_s, now_s = recorded.position_after.get(name), simulated.position_after.get(name)
        if (before_s is None) != (now_s is None) or abs((before_s or 0) - (now_s or 0)) > 1:
            yield f"first {name}", *("never" if time is None else f"after {time} s" for time in (before_s, now_s))
    only = recorded.types - simulated.types, simulated.types - recorded.types
    if only != (set(), set()):
        yield "messages of one only", _joined(sorted(only[0]), ", "), _joined(sorted(only[1]), ", ")
