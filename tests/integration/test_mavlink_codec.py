"""Ponte's MAVLink codec against pymavlink: every message of ardupilotmega and common, versions 1 and 2, both ways."""

from __future__ import annotations

import json
import random
from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from pymavlink.dialects.v10 import ardupilotmega as ardupilotmega_v1
from pymavlink.dialects.v10 import common as common_v1
from pymavlink.dialects.v20 import ardupilotmega as ardupilotmega_v2
from pymavlink.dialects.v20 import common as common_v2

from mavlink_values import Values, differences, samples, to_json
from programs import parse_json, run, seed_or

DIALECTS = {1: ardupilotmega_v1, 2: ardupilotmega_v2}
RANDOM_SAMPLES = 24
MESSAGES_SHOWN = 30
DEFAULT_SEED = 20160214


@dataclass(frozen=True)
class Case:
    """One frame as pymavlink packs it, and what is in it."""

    version: int
    message_class: Any
    sample: Values
    system: int
    component: int
    sequence: int
    frame: bytes

    @property
    def title(self) -> str:
        return f"{self.message_class.msgname} ({self.message_class.id}) MAVLink {self.version}"

    def encode_request(self) -> dict[str, Any]:
        return {
            "id": self.message_class.id,
            "version": self.version,
            "system": self.system,
            "component": self.component,
            "sequence": self.sequence,
            "fields": to_json(self.message_class, self.sample),
        }


def make_case(dialect: ModuleType, version: int, message_class: Any, sample: Values, source: random.Random) -> Case:
    """Packs a sample with pymavlink."""
    system, component, sequence = (source.choice((0, 1, 127, 255)) for _ in range(3))
    link = dialect.MAVLink(None, srcSystem=system, srcComponent=component)
    link.seq = sequence
    message = message_class(*(sample[name] for name in message_class.fieldnames))
    return Case(version, message_class, sample, system, component, sequence, bytes(message.pack(link)))


def all_cases(seed: int) -> Iterator[Case]:
    """Every message in every version. Each message has its own generator, so that one can be repeated alone."""
    for version, dialect in DIALECTS.items():
        for message_id, message_class in sorted(dialect.mavlink_map.items()):
            source = random.Random(f"{seed}/{version}/{message_id}")
            for sample in samples(message_class, source, RANDOM_SAMPLES):
                yield make_case(dialect, version, message_class, sample, source)


def header_differences(case: Case, answer: dict[str, Any]) -> list[str]:
    wanted = {
        "id": case.message_class.id,
        "name": case.message_class.msgname,
        "version": case.version,
        "system": case.system,
        "component": case.component,
        "sequence": case.sequence,
    }
    wrong = {key: value for key, value in wanted.items() if answer.get(key) != value}
    return [f"{key} is {answer.get(key)!r} instead of {value!r}" for key, value in wrong.items()]


def judge_decoding(case: Case, answer: dict[str, Any]) -> list[str]:
    """What is wrong with the answer to a frame."""
    if "error" in answer:
        return [f"error {answer['error']!r}"]
    found = header_differences(case, answer)
    found += differences(case.message_class, case.sample, answer.get("fields", {}))
    if answer.get("reencoded") != case.frame.hex():
        found.append(f"encoded again as {answer.get('reencoded')}")
    return found


def judge_encoding(case: Case, answer: dict[str, Any]) -> list[str]:
    """What is wrong with the answer to values: other bytes than pymavlink's, or values that pymavlink reads otherwise."""
    if "error" in answer:
        return [f"error {answer['error']!r}"]
    found = [] if answer.get("frame") == case.frame.hex() else [f"encoded as {answer.get('frame')}"]
    try:
        message = DIALECTS[case.version].MAVLink(None).decode(bytearray.fromhex(answer.get("frame", "")))
    except Exception as error:  # pymavlink raises many kinds for a bad frame, and each is a finding here
        return [*found, f"pymavlink refuses the frame: {error}"]
    read = {name: value_of(message, name) for name in case.message_class.fieldnames}
    return found + differences(case.message_class, case.sample, to_json(case.message_class, read))


def value_of(message: Any, name: str) -> Any:
    """A field of a message decoded by pymavlink, text as bytes."""
    value = getattr(message, name)
    return value.encode("ascii") if isinstance(value, str) else value


def ask(probe: Path, requests: list[dict[str, Any] | str]) -> list[dict[str, Any]]:
    """Sends all requests through one process and gives the answers, one for each."""
    lines = [request if isinstance(request, str) else json.dumps(request, allow_nan=False) for request in requests]
    finished = run([probe], "\n".join(lines) + "\n")
    answers = [parse_json(line) for line in finished.stdout.splitlines()]
    assert len(answers) == len(lines), f"{len(lines)} requests, {len(answers)} answers; stderr: {finished.stderr[-2000:]}"
    assert finished.returncode == 0, f"status {finished.returncode}: {finished.stderr[-2000:]}"
    return answers


def report(seed: int, wrong: dict[str, list[str]], asked: int) -> str:
    """One line for each message with something wrong: how often, and the first finding with its frame."""
    lines = [f"{title}: {len(findings)} times, first: {findings[0]}" for title, findings in sorted(wrong.items())]
    head = f"{len(wrong)} messages differ, {asked} frames, PONTE_SEED={seed}"
    return "\n".join([head, *lines[:MESSAGES_SHOWN], *(["..."] if len(lines) > MESSAGES_SHOWN else [])])


Judge = Callable[[Case, dict[str, Any]], list[str]]


def judge_all(probe: Path, seed: int, request_of: Callable[[Case], dict[str, Any]], judge: Judge) -> None:
    cases = list(all_cases(seed))
    wrong: defaultdict[str, list[str]] = defaultdict(list)
    for case, answer in zip(cases, ask(probe, [request_of(case) for case in cases]), strict=True):
        if found := judge(case, answer):
            wrong[case.title].append(f"{'; '.join(found)[:400]} [pymavlink: {case.frame.hex()}]")
    assert not wrong, report(seed, wrong, len(cases))


@pytest.mark.parametrize("small, large", [(common_v1, ardupilotmega_v1), (common_v2, ardupilotmega_v2)])
def test_common_is_wholly_inside_ardupilotmega(small: ModuleType, large: ModuleType) -> None:
    """So the tests below, which go through ardupilotmega, go through every message of common too."""

    def facts(message_class: Any) -> tuple[Any, ...]:
        c = message_class
        return c.msgname, c.crc_extra, c.fieldnames, c.ordered_fieldnames, c.fieldtypes, c.array_lengths

    in_large = {i: facts(c) for i, c in large.mavlink_map.items()}
    assert [i for i, c in small.mavlink_map.items() if in_large.get(i) != facts(c)] == []


def test_samples_come_for_every_message_of_both_versions() -> None:
    counts: defaultdict[tuple[int, int], int] = defaultdict(int)
    for case in all_cases(DEFAULT_SEED):
        counts[case.version, case.message_class.id] += 1
    assert {i for version, i in counts if version == 2} == set(ardupilotmega_v2.mavlink_map)
    assert {i for version, i in counts if version == 1} == {i for i in ardupilotmega_v2.mavlink_map if i < 256}
    assert min(counts.values()) >= 20


def test_frames_of_pymavlink_are_decoded_and_encoded_again(probe: Callable[[str], Path]) -> None:
    judge_all(probe("ponte_mavlink_probe"), seed_or(DEFAULT_SEED), lambda case: {"frame": case.frame.hex()}, judge_decoding)


def test_values_become_the_frames_of_pymavlink(probe: Callable[[str], Path]) -> None:
    judge_all(probe("ponte_mavlink_probe"), seed_or(DEFAULT_SEED), Case.encode_request, judge_encoding)


def heartbeat(version: int) -> bytes:
    """A HEARTBEAT whose last payload byte is not zero, so that both versions send it whole."""
    link = DIALECTS[version].MAVLink(None, srcSystem=1, srcComponent=1)
    return bytes(DIALECTS[version].MAVLink_heartbeat_message(2, 3, 81, 4, 3, 3).pack(link))


@pytest.mark.parametrize("version", [1, 2])
def test_damaged_frames_are_refused(probe: Callable[[str], Path], version: int) -> None:
    """Every byte changed in turn, and every shorter length; a good frame at the end shows that the probe goes on."""
    good = heartbeat(version)
    damaged = [good[:i] + bytes((good[i] ^ 0x10,)) + good[i + 1 :] for i in range(len(good))]
    damaged += [good[:size] for size in range(len(good))]
    answers = ask(probe("ponte_mavlink_probe"), [{"frame": frame.hex()} for frame in [*damaged, good]])
    accepted = [frame.hex() for frame, answer in zip(damaged, answers) if set(answer) != {"error"}]
    assert accepted == []
    assert answers[-1].get("name") == "HEARTBEAT"


def test_requests_that_make_no_sense_get_an_error(probe: Callable[[str], Path]) -> None:
    unknown = {"id": 0xABCDEF, "version": 2, "system": 1, "component": 1, "sequence": 0, "fields": {}}
    version_1_cannot = {"id": 300, "version": 1, "system": 1, "component": 1, "sequence": 0, "fields": {}}
    answers = ask(probe("ponte_mavlink_probe"), [unknown, version_1_cannot, {"frame": "xyz"}, {}, "no json", "[]"])
    assert [set(answer) for answer in answers] == [{"error"}] * 6
