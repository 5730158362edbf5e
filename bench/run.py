"""Runs the benchmarks beside their peers, prints a table, and writes one JSON object per line if asked to.

Each figure is a ratio against a peer in the same run where there is one; the targets are those of the issues.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import page
import planning
import upload
from figure import HEADING, Figure
from mavlink import figures as mavlink

RECORDING = Path("tests/recordings/px4_mission_v2_trimmed.tlog.gz")


def machine() -> str:
    """The processor, how many of it, and the compiler, to be read with the figures."""
    models = [line.partition(":")[2] for line in Path("/proc/cpuinfo").read_text().splitlines() if "model name" in line]
    compiler = subprocess.run(["g++", "--version"], check=True, capture_output=True, text=True).stdout.splitlines()[0]
    return f"{os.cpu_count()} x {(models or [platform.machine()])[0].strip()}, {compiler}"


def measured_by(program: Path) -> dict[str, float]:
    """What a benchmark program prints: the value of each case."""
    output = subprocess.run([program, RECORDING], check=True, capture_output=True, text=True).stdout
    return {figure["case"]: figure["value"] for figure in map(json.loads, output.splitlines())}


def vsm(programs: Path) -> list[Figure]:
    value = measured_by(programs / "bench_vsm")
    alone = [("frame to DLI bytes p50", 2000.0), ("frame to DLI bytes p99", 10000.0)]
    relay = "plain relay"
    through = [("p50", 1.25), ("p99", None)]
    return [Figure("vsm", case, value[case], "ns", target=target) for case, target in alone] + [
        Figure(
            "vsm", f"over loopback {part}", value[f"over loopback {part}"], "ns", relay, value[f"{relay} {part}"],
            target, of_ratio=True,
        )  # fmt: skip
        for part, target in through
    ]


def world(programs: Path) -> list[Figure]:
    value = measured_by(programs / "bench_world")["virtual time"]
    return [Figure("world", "virtual time", value, "x real", target=1000.0, at_least=True)]


def sim(programs: Path) -> list[Figure]:
    """Seconds of one core for each second in which 200 vehicles fly: below 1 is real time."""
    return [Figure("sim", case, value, "s/s", target=1) for case, value in measured_by(programs / "bench_sim").items()]


BENCHES: dict[str, Callable[[Path], Iterable[Figure]]] = {
    "mavlink": mavlink.figures,
    "vsm": vsm,
    "world": world,
    "sim": sim,
    "page": page.figures,
    "planning": planning.figures,
    "upload": upload.figures,
}


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("names", nargs="*", metavar="NAME", help=f"only these: {', '.join(BENCHES)}")
    arguments.add_argument("--programs", type=Path, required=True)
    arguments.add_argument("--output-json", type=Path)
    options = arguments.parse_args()
    if unknown := set(options.names) - set(BENCHES):
        arguments.error(f"no such benchmark: {', '.join(sorted(unknown))}; there is {', '.join(BENCHES)}")

    figures: list[Figure] = []
    print(machine(), HEADING, sep="\n")
    for name in options.names or BENCHES:
        for figure in BENCHES[name](options.programs):
            figures.append(figure)
            print(figure.as_row(), flush=True)
    if options.output_json:
        options.output_json.write_text("".join(figure.as_json() + "\n" for figure in figures))
    return 0


if __name__ == "__main__":
    sys.exit(main())
