"""Runs the benchmarks beside their peers, prints a table, and writes one JSON object per line if asked to.

Each figure is a ratio against a peer in the same run where there is one; the targets are those of the issues.
"""

import argparse
import gzip
import json
import subprocess
import sys
import time
from pathlib import Path

from pymavlink.dialects.v20 import all as dialect

RECORDING = Path("tests/recordings/px4_mission_v2_trimmed.tlog.gz")
REPETITIONS = 3
TARGETS = {"parse": ("ratio", 8.0), "translate p50": ("at most", 2000.0), "translate p99": ("at most", 10000.0)}


def frames_of(recording: Path) -> bytes:
    """The frames back to back: each record is eight bytes of time and one frame."""
    data = gzip.decompress(recording.read_bytes())
    stream = bytearray()
    at = 0
    while at + 8 < len(data):
        start, length = data[at + 8], data[at + 9]
        size = length + 8 if start == 0xFE else length + 12 + (13 if data[at + 10] & 1 else 0)
        stream += data[at + 8 : at + 8 + size]
        at += 8 + size
    return bytes(stream)


def pymavlink_rate(stream: bytes) -> float:
    """Frames per second, the best of several passes."""
    best = 0.0
    for _ in range(REPETITIONS):
        parser = dialect.MAVLink(None)
        parser.robust_parsing = True
        count = 0
        start = time.perf_counter()
        for at in range(0, len(stream), 1500):
            count += len(parser.parse_buffer(stream[at : at + 1500]) or [])
        best = max(best, count / (time.perf_counter() - start))
    return best


def judge(name: str, value: float, peer_value: float | None) -> tuple[float | None, float, bool]:
    kind, target = TARGETS[name]
    ratio = value / peer_value if peer_value else None
    return ratio, target, (ratio >= target if kind == "ratio" and ratio else value <= target)


def main() -> int:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("names", nargs="*", help="only these: read_recording")
    arguments.add_argument("--programs", type=Path, required=True)
    arguments.add_argument("--output-json", type=Path)
    options = arguments.parse_args()
    known = {"read_recording"}
    if unknown := set(options.names) - known:
        arguments.error(f"no such benchmark: {', '.join(sorted(unknown))}; there is {', '.join(sorted(known))}")

    output = subprocess.run(
        [options.programs / "bench_read_recording", RECORDING], check=True, capture_output=True, text=True
    ).stdout
    peers = {"parse": ("pymavlink", pymavlink_rate(frames_of(RECORDING)))}
    lines = []
    print(f"{'bench':16} {'case':16} {'value':>14} {'unit':9} {'peer':10} {'peer value':>12} {'ratio':>8} {'target':>9}")
    for figure in map(json.loads, output.splitlines()):
        name, value = figure["case"], figure["value"]
        peer, peer_value = peers.get(name, (None, None))
        ratio, target, passed = judge(name, value, peer_value)
        lines.append(
            {"bench": "read_recording", "case": name, "value": value, "unit": figure["unit"], "peer": peer,
             "peer_value": peer_value, "ratio": ratio, "target": target, "pass": passed}
        )
        print(
            f"{'read_recording':16} {name:16} {value:14.0f} {figure['unit']:9} {peer or '-':10} "
            f"{peer_value or 0:12.0f} {ratio or 0:8.1f} {target:9.0f} {'pass' if passed else 'MISSED'}"
        )
    if options.output_json:
        options.output_json.write_text("".join(json.dumps(line) + "\n" for line in lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
