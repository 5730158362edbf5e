"""The figures of `./run bench mavlink`: ponte beside the C headers of mavgen (-O2, -O3) and pymavlink, on one corpus.

All count processor time, and the programs take turns, so that a busy machine slows them down alike. Before anything is
compared, all must have found the same frames and the same values in every field.
"""

from __future__ import annotations

import json
import statistics
import subprocess
import time
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from figure import Figure

TURNS = 3  # of five passes each
CLEAN = ("v1", "v2", "v2_signed")
CHUNKS = {"1": 1.0, "64": 4.0, "1500": 8.0, "65536": 8.0}  # bytes: how many times as fast as the C headers
LEAST_OF_CHECKSUM_SPEED = 0.45
MOST_FOR_NOISE = 2.0
LEAST_ROUTED_PER_SECOND = 150_000.0
PEERS = {"C -O2": "peer_mavlink_O2", "C -O3": "peer_mavlink_O3"}

Cases = dict[str, dict[str, Any]]


def one_turn(program: Path, corpus: Path) -> Cases:
    lines = subprocess.run([program, corpus], check=True, capture_output=True, text=True).stdout.splitlines()
    return {case["case"]: case for case in map(json.loads, lines)}


def all_turns(programs: dict[str, Path], corpus: Path) -> dict[str, Cases]:
    """Each program's cases, with the median of its times."""
    turns: dict[str, list[Cases]] = defaultdict(list)
    for _ in range(TURNS):
        for name, program in programs.items():
            turns[name].append(one_turn(program, corpus))
    return {
        name: {
            case: each[0][case] | {"ns": statistics.median(turn[case]["ns"] for turn in each)} for case in each[0]
        }
        for name, each in turns.items()
    }


def pymavlink_ns(stream: bytes) -> tuple[float, int]:
    """Nanoseconds of processor time for a frame, and the number of frames."""
    from pymavlink.dialects.v20 import ardupilotmega as dialect

    parser = dialect.MAVLink(None)
    parser.robust_parsing = True
    count, begin = 0, time.process_time()
    for at in range(0, len(stream), 1500):
        count += len(parser.parse_buffer(stream[at : at + 1500]) or [])
    return (time.process_time() - begin) / count * 1e9, count


def check(measured: dict[str, Cases], frames: int, intact: int) -> None:
    """Ends the benchmark if the programs do not agree on what the corpus says."""
    ours = measured["ponte"]
    for peer in PEERS:
        theirs = measured[peer]
        pairs = [(ours[f"decode {version} 1500"], theirs[f"decode {version}"]) for version in CLEAN]
        for our, their in [*pairs, (ours["encode"], theirs["encode"])]:
            if (our["frames"], our["hash"]) != (their["frames"], their["hash"]):
                raise SystemExit(f"ponte and {peer} do not agree: {our}, {their}")
    if any(cases["verify v2_signed"]["frames"] != frames for cases in measured.values()):
        raise SystemExit("signatures of the corpus were refused")
    if any(ours[f"decode {version} {chunk}"]["frames"] != frames for version in CLEAN for chunk in CHUNKS):
        raise SystemExit("ponte has lost frames of a clean corpus")
    if any(ours[f"decode v2_noisy {chunk}"]["frames"] < intact for chunk in CHUNKS):
        raise SystemExit("ponte has lost intact frames of the noisy corpus")


def router(programs: Path) -> Iterable[Figure]:
    """Over loopback UDP, beside a relay that passes the same datagrams on untouched; bench/router.cpp."""
    lines = subprocess.run([programs / "bench_router"], check=True, capture_output=True, text=True).stdout.splitlines()
    value = {figure["case"]: figure["value"] for figure in map(json.loads, lines)}
    peer = "plain relay"
    without_loss = "without loss"
    yield Figure(
        "mavlink", "route without loss", value[f"router {without_loss}"], "msg/s", peer, value[f"relay {without_loss}"],
        LEAST_ROUTED_PER_SECOND, at_least=True,
    )  # fmt: skip
    for case, unit in {"lost": "messages", "processor": "ns/msg"}.items():
        yield Figure(
            "mavlink", f"route 160000/s {case}", value[f"router {case}"], unit, peer, value[f"relay {case}"]
        )


def figures(programs: Path) -> Iterable[Figure]:
    yield from codec(programs)
    yield from router(programs)


def codec(programs: Path) -> Iterable[Figure]:
    corpus = programs.parent / "mavlink_corpus"
    facts = json.loads((corpus / "corpus.json").read_text())
    measured = all_turns(
        {"ponte": programs / "bench_mavlink"} | {peer: programs / name for peer, name in PEERS.items()}, corpus
    )
    check(measured, facts["frames"], facts["intact"])
    ours = measured["ponte"]

    def rate(cases: Cases, case: str) -> float:
        return 1e9 / float(cases[case]["ns"])

    for version in (*CLEAN, "v2_noisy"):
        for chunk, target in CHUNKS.items():
            for peer in PEERS:
                yield Figure(
                    "mavlink", f"decode {version} by {chunk}", rate(ours, f"decode {version} {chunk}"), "frames/s",
                    peer, rate(measured[peer], f"decode {version}"), target, at_least=True, of_ratio=True,
                )  # fmt: skip
    for peer in PEERS:
        yield Figure(
            "mavlink", "verify v2_signed by 1500", rate(ours, "verify v2_signed"), "frames/s", peer,
            rate(measured[peer], "verify v2_signed"), 1.5, at_least=True, of_ratio=True,
        )  # fmt: skip
    python_ns, count = pymavlink_ns((corpus / "v2.bin").read_bytes())
    assert count == facts["frames"]
    yield Figure("mavlink", "decode v2 by 1500", rate(ours, "decode v2 1500"), "frames/s", "pymavlink", 1e9 / python_ns)
    yield Figure(
        "mavlink", "find v2 by 1500", rate(ours, "parse v2 1500"), "frames/s", "its checksum alone",
        rate(ours, "checksum v2"), LEAST_OF_CHECKSUM_SPEED, at_least=True, of_ratio=True,
    )  # fmt: skip
    noisy = facts["intact"] / facts["frames"]  # the bytes are nearly as many, the frames are fewer
    yield Figure(
        "mavlink", "decode v2_noisy by 1500", ours["decode v2_noisy 1500"]["ns"] * noisy, "ns/sent", "clean",
        ours["decode v2 1500"]["ns"], MOST_FOR_NOISE, of_ratio=True,
    )  # fmt: skip
    for peer in PEERS:
        yield Figure(
            "mavlink", "encode", rate(ours, "encode"), "frames/s", peer, rate(measured[peer], "encode"), 3.0,
            at_least=True, of_ratio=True,
        )  # fmt: skip
