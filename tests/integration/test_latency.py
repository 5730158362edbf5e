"""`ponte latency` against `ponte sim`. What it writes is judged with Python's own statistics; no speed is judged but the
verdict's."""

from __future__ import annotations

import csv
import os
import resource
import shutil
import signal
import socket
import statistics
import subprocess
import threading
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import ardupilotmega as dialect

from programs import parse_json, run

SAMPLES = 12
QUANTITIES = ["direct", "converted", "delay", "decode", "translate", "send", "present_direct", "present_converted"]
COLUMNS = ["index", "time_us", "sequence", "received_us", "decoded_us", "translated_us", "sent_us", "present_direct_us",
           "present_converted_us", "direct_us", "converted_us", "delay_us"]  # fmt: skip


def free_port() -> int:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@pytest.fixture(scope="module")
def vehicle(ponte: Path) -> Iterator[str]:
    """The endpoint where a simulated vehicle speaks."""
    place = f"127.0.0.1:{free_port()}"
    process = subprocess.Popen([ponte, "sim", "--endpoint", f"udpout://{place}", "--quiet"])
    yield f"udpin://{place}"
    process.terminate()
    process.wait()


@dataclass
class Study:
    folder: Path
    finished: subprocess.CompletedProcess[str]

    @property
    def result(self) -> Any:
        return parse_json((self.folder / "out.json").read_text())

    @property
    def rows(self) -> list[dict[str, str]]:
        return list(csv.DictReader((self.folder / "out.csv").read_text().splitlines()))


@pytest.fixture(scope="module")
def study(ponte: Path, vehicle: str, tmp_path_factory: pytest.TempPathFactory) -> Study:
    folder = tmp_path_factory.mktemp("latency")
    files = [part for kind in ("csv", "json", "html") for part in (f"--output-{kind}", folder / f"out.{kind}")]
    return Study(folder, run([ponte, "latency", "--vehicle", vehicle, "--samples", str(SAMPLES), *files]))


def test_a_vehicle_passes(study: Study) -> None:
    assert study.finished.returncode == 0, study.finished.stderr
    table = study.finished.stdout
    print(table)
    assert "All times in microseconds" in table
    assert len([line for line in table.splitlines() if line.strip()[:1].isdigit()]) == SAMPLES
    assert table.splitlines()[-1].startswith("PASS: ")
    assert study.result["pass"] is True
    assert study.result["limit_ms"] == 500


def test_csv_and_json_tell_the_same(study: Study) -> None:
    assert list(study.rows[0]) == COLUMNS
    assert [{name: float(text) for name, text in row.items()} for row in study.rows] == study.result["samples"]
    assert [sample["index"] for sample in study.result["samples"]] == list(range(1, SAMPLES + 1))


def test_the_times_of_a_sample_add_up(study: Study) -> None:
    last = -1.0
    for sample in study.result["samples"]:
        assert sample["received_us"] >= last
        last = sample["received_us"]
        assert 0 <= sample["decoded_us"] <= sample["translated_us"] <= sample["sent_us"]
        assert sample["present_direct_us"] > 0 and sample["present_converted_us"] > 0
        assert sample["direct_us"] == pytest.approx(sample["decoded_us"] + sample["present_direct_us"])
        assert sample["converted_us"] == pytest.approx(sample["sent_us"] + sample["present_converted_us"])
        assert sample["delay_us"] == pytest.approx(sample["converted_us"] - sample["direct_us"])


def series(samples: list[dict[str, float]], name: str) -> list[float]:
    if name == "decode":
        return [sample["decoded_us"] for sample in samples]
    if name == "translate":
        return [sample["translated_us"] - sample["decoded_us"] for sample in samples]
    if name == "send":
        return [sample["sent_us"] - sample["translated_us"] for sample in samples]
    return [sample[f"{name}_us"] for sample in samples]


@pytest.mark.parametrize("name", QUANTITIES)
def test_the_statistics_are_right(study: Study, name: str) -> None:
    result = study.result
    values = series(result["samples"], name)
    percentiles = statistics.quantiles(values, n=100, method="inclusive")
    line = statistics.linear_regression(range(1, SAMPLES + 1), values)
    assert result["summary"][name] == pytest.approx(
        {
            "count": SAMPLES,
            "mean_us": statistics.fmean(values),
            "median_us": statistics.median(values),
            "p95_us": percentiles[94],
            "p99_us": percentiles[98],
            "min_us": min(values),
            "max_us": max(values),
            "standard_deviation_us": statistics.stdev(values),
            "peak_to_peak_us": max(values) - min(values),
            "slope_us_per_sample": line.slope,
            "intercept_us": line.intercept,
        },
        abs=1e-6,
    )
    assert list(result["summary"]) == QUANTITIES


def test_the_conditions_are_told(study: Study, vehicle: str) -> None:
    result = study.result
    assert result["conditions"]["vehicle"] == vehicle
    assert result["conditions"]["host"] == os.uname().nodename
    assert os.uname().release in result["conditions"]["kernel"]
    assert result["conditions"]["realtime"] == "no"
    assert result["wakeups_late"]["count"] > 0
    assert result["wakeups_late"]["min_us"] >= 0


def test_the_page_stands_alone_and_has_three_charts(study: Study, vehicle: str) -> None:
    text = (study.folder / "out.html").read_text()
    for outside in ("http:", "https:", "//cdn", "src=", "href=", "url(", "@import", "<script"):
        assert outside not in text
    page = ElementTree.fromstring(text)
    charts = page.findall(".//svg")
    assert len(charts) == 3
    lines = [list(chart.iter("polyline")) for chart in charts]
    assert [len(of_chart) for of_chart in lines] == [2, 3, 2]
    for chart, of_chart in zip(charts, lines):
        assert chart.findtext("title") and chart.findtext("desc")
        assert {len(line.attrib["points"].split()) for line in of_chart} == {SAMPLES}
    result = study.result
    times = [series(result["samples"], name) for name in ("direct", "converted", "delay")]
    trend = result["summary"]["delay"]
    line = [trend["intercept_us"] + trend["slope_us_per_sample"] * (index + 1) for index in range(SAMPLES)]
    for drawn, values in zip(lines, [times[:2], times, [times[2], line]]):
        assert_drawn(drawn, values)
    assert "PASS" in (page.findtext(".//p[@class='verdict pass']") or "")
    assert vehicle in "".join(page.itertext())


def assert_drawn(lines: list[ElementTree.Element], values: list[list[float]]) -> None:
    """All lines of a chart are drawn to one scale: equal steps to the right, greater values higher up."""
    points = [[tuple(map(float, point.split(","))) for point in line.attrib["points"].split()] for line in lines]
    heights = [y for of_line in points for _, y in of_line]
    scale = statistics.linear_regression([value for of_line in values for value in of_line], heights)
    assert scale.slope < 0
    for of_line, wanted in zip(points, values):
        steps = [right[0] - left[0] for left, right in zip(of_line, of_line[1:])]
        assert steps == pytest.approx([steps[0]] * len(steps), abs=0.11)
        assert [y for _, y in of_line] == pytest.approx([scale.intercept + scale.slope * v for v in wanted], abs=0.15)


def test_json_lines(ponte: Path, vehicle: str) -> None:
    finished = run([ponte, "latency", "--vehicle", vehicle, "--samples", "3", "--json", "--quiet"])
    assert (finished.returncode, finished.stderr) == (0, "")
    *samples, summary = [parse_json(line) for line in finished.stdout.splitlines()]
    assert [sample["index"] for sample in samples] == [1, 2, 3]
    assert list(samples[0]) == COLUMNS
    assert summary["summary"]["delay"]["count"] == 3


def test_a_single_sample_is_a_study_too(ponte: Path, vehicle: str, tmp_path: Path) -> None:
    page = tmp_path / "one.html"
    finished = run([ponte, "latency", "--vehicle", vehicle, "--samples", "1", "--quiet", "--output-html", page])
    assert finished.returncode == 0, finished.stderr
    for chart in ElementTree.fromstring(page.read_text()).iter("svg"):
        assert "nan" not in ElementTree.tostring(chart, "unicode")


def test_a_limit_that_is_exceeded_fails(ponte: Path, vehicle: str, tmp_path: Path) -> None:
    page = tmp_path / "fail.html"
    finished = run([ponte, "latency", "--vehicle", vehicle, "--samples", "3", "--limit-ms", "0.000001", "--quiet",
                    "--output-html", page])  # fmt: skip
    assert finished.returncode == 1
    assert finished.stdout.splitlines()[-1] == finished.stderr.strip()
    assert finished.stderr.startswith("FAIL: the greatest delay, ")
    assert "ms above the limit of 1e-06 ms" in finished.stderr
    assert "FAIL" in (ElementTree.fromstring(page.read_text()).findtext(".//p[@class='verdict fail']") or "")


def failure_of(ponte: Path, vehicle: str, patience_s: str) -> str:
    """The one line with which a study that cannot be done ends."""
    finished = run([ponte, "latency", "--vehicle", vehicle, "--patience", patience_s, "--quiet"])
    assert (finished.returncode, finished.stdout) == (1, "")
    assert len(finished.stderr.splitlines()) == 1
    return finished.stderr


def test_silence_is_said(ponte: Path) -> None:
    endpoint = f"udpin://127.0.0.1:{free_port()}"
    line = failure_of(ponte, endpoint, "0.5")
    assert endpoint in line and "0 of 30 samples" in line and "nothing was heard in 0.5 s" in line


def frame(name: str, *values: Any) -> bytes:
    message = getattr(dialect, f"MAVLink_{name}_message")(*values)
    return bytes(message.pack(dialect.MAVLink(None, srcSystem=1, srcComponent=1)))


HEARTBEAT = frame("heartbeat", 2, 3, 81, 0, 3, 3)
ATTITUDE = frame("attitude", 1, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("said", "reason"),
    [
        (b"what no vehicle says", "no MAVLink frame came"),
        (ATTITUDE, "no HEARTBEAT of an autopilot"),
        (HEARTBEAT, "no ATTITUDE, though it was asked for"),
    ],
    ids=["noise", "no heartbeat", "no attitude"],
)
def test_what_was_heard_instead_is_said(ponte: Path, said: bytes, reason: str) -> None:
    port = free_port()
    with talking_to(port, said):
        assert reason in failure_of(ponte, f"udpin://127.0.0.1:{port}", "2")


@contextmanager
def talking_to(port: int, datagram: bytes) -> Iterator[None]:
    """Somebody who says the same again and again, whether anybody listens or not."""
    end = threading.Event()

    def talk() -> None:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as mouth:
            while not end.wait(0.02):
                mouth.sendto(datagram, ("127.0.0.1", port))

    thread = threading.Thread(target=talk)
    thread.start()
    yield
    end.set()
    thread.join()


# There was no wake-up of the timer to summarise.
def test_a_study_that_is_over_at_once(ponte: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        endpoint = f"tcpout://127.0.0.1:{server.getsockname()[1]}"
        command = [ponte, "latency", "--vehicle", endpoint, "--samples", "1", "--quiet"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            connection, _ = server.accept()
            connection.sendall(HEARTBEAT + ATTITUDE)
            assert process.stdout is not None
            assert process.stdout.read().splitlines()[-1].startswith("PASS: ")
            connection.close()
    assert process.returncode == 0


def test_an_interrupted_study_says_how_far_it_came(ponte: Path, vehicle: str) -> None:
    command = [ponte, "latency", "--vehicle", vehicle, "--samples", "10000"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None and process.stdout is not None
        while "vehicle appeared" not in process.stderr.readline():
            assert process.poll() is None
        process.send_signal(signal.SIGINT)
        last = process.stderr.read().splitlines()[-1]
        assert (process.wait(), process.stdout.read()) == (1, "")
    assert last.endswith("of 10000 samples: interrupted")


@pytest.mark.parametrize(
    "options",
    [
        ["--vehicle", "file:///tmp/flight.tlog"],
        ["--vehicle", "nowhere"],
        ["--vehicle", "udpin://127.0.0.1:14550", "--samples", "0"],
        ["--vehicle", "udpin://127.0.0.1:14550", "--limit-ms", "0"],
        ["--vehicle", "udpin://127.0.0.1:14550", "--realtime", "100"],
        [],
    ],
)
def test_bad_usage_ends_with_status_2(ponte: Path, options: list[str]) -> None:
    finished = run([ponte, "latency", *options])
    assert (finished.returncode, finished.stdout) == (2, "")
    assert finished.stderr


def test_a_page_that_cannot_be_written_fails_after_the_table(ponte: Path, vehicle: str, tmp_path: Path) -> None:
    missing = tmp_path / "missing" / "out.html"
    finished = run([ponte, "latency", "--vehicle", vehicle, "--samples", "2", "--quiet", "--output-html", missing])
    assert finished.returncode == 1
    assert finished.stdout.splitlines()[-1].startswith("PASS: ")
    assert finished.stderr == f"{missing}: cannot be written: No such file or directory\n"


def without_capabilities(*names: str) -> list[str]:
    """What to put before a command to take permissions from it. Only root has any to lose."""
    if os.geteuid() != 0:
        return []
    if shutil.which("setpriv") is None:
        pytest.skip("setpriv is not installed")
    dropped = ",".join(f"-{name}" for name in names)
    return ["setpriv", f"--bounding-set={dropped}", f"--inh-caps={dropped}"]


def test_a_priority_that_is_not_permitted_says_what_to_do(ponte: Path, vehicle: str) -> None:
    limit, _ = resource.getrlimit(resource.RLIMIT_RTPRIO)
    if limit != 0:
        pytest.skip("this user may have the priority")
    command = [ponte, "latency", "--vehicle", vehicle, "--realtime", "50", "--quiet"]
    finished = run([*without_capabilities("sys_nice"), *command])
    assert (finished.returncode, finished.stdout) == (1, "")
    assert finished.stderr.startswith("--realtime 50: the system refuses the priority")
    assert "CAP_SYS_NICE" in finished.stderr and "docs/realtime.md" in finished.stderr
    assert len(finished.stderr.splitlines()) == 1


@pytest.mark.parametrize("command", ["latency", "vsm"])
def test_realtime_runs_where_it_is_permitted(ponte: Path, vehicle: str, command: str) -> None:
    with subprocess.Popen([ponte, command, "--vehicle", vehicle, "--realtime", "7"], stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        while line := process.stderr.readline():
            if "the system" in line:
                pytest.skip(f"not permitted here: {line}")
            if "vehicle appeared" in line:
                break
        assert os.sched_getscheduler(process.pid) & ~os.SCHED_RESET_ON_FORK == os.SCHED_FIFO
        assert os.sched_getparam(process.pid).sched_priority == 7
        process.send_signal(signal.SIGINT)
        process.stderr.read()
