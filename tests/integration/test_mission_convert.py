"""`ponte mission convert` before independent readers: the standard library's JSON, XML, CSV and zip, and pymavlink's own
reader and writer of waypoint files."""

from __future__ import annotations

import csv
import json
import math
import random
import struct
import subprocess
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from pymavlink import mavwp

from programs import REPOSITORY, json_objects, run, seed_or

VECTORS = REPOSITORY / "tests" / "vectors" / "missions"
KML = "{http://www.opengis.net/kml/2.2}"
GPX = "{http://www.topografix.com/GPX/1/1}"
LATITUDE, LONGITUDE = 4, 5

Place = tuple[float, float]


def convert(ponte: Path, source: Path, target: Path, *options: str) -> subprocess.CompletedProcess[str]:
    finished = run([ponte, "mission", "convert", source, target, *options])
    assert finished.returncode == 0, finished.stderr
    return finished


def places_in_poi(path: Path) -> list[Place]:
    return list(struct.iter_unpack("<dd", path.read_bytes()))


def places_in_csv(path: Path) -> list[Place]:
    with path.open(encoding="utf-8", newline="") as file:
        return [(float(row["latitude"]), float(row["longitude"])) for row in csv.DictReader(file)]


def places_in_geojson(path: Path) -> list[Place]:
    features = json.loads(path.read_text(encoding="utf-8"))["features"]
    return [(f["geometry"]["coordinates"][1], f["geometry"]["coordinates"][0]) for f in features]


def places_in_kml_text(text: bytes) -> list[Place]:
    tuples = [node.text.split(",") for node in ElementTree.fromstring(text).iter(f"{KML}coordinates") if node.text]
    return [(float(latitude), float(longitude)) for longitude, latitude, _ in tuples]


def places_in_kml(path: Path) -> list[Place]:
    return places_in_kml_text(path.read_bytes())


def places_in_kmz(path: Path) -> list[Place]:
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        return places_in_kml_text(archive.read("doc.kml"))


def places_in_gpx(path: Path) -> list[Place]:
    root = ElementTree.parse(path).getroot()
    return [(float(node.attrib["lat"]), float(node.attrib["lon"])) for node in root.iter(f"{GPX}wpt")]


def places_in_plan(path: Path) -> list[Place]:
    items = json.loads(path.read_text(encoding="utf-8"))["mission"]["items"]
    return [(item["params"][LATITUDE], item["params"][LONGITUDE]) for item in items]


def load_waypoints(path: Path) -> list[Any]:
    loader = mavwp.MAVWPLoader()
    loader.load(str(path))
    return loader.wpoints


def places_in_wpl(path: Path) -> list[Place]:
    return [(item.x, item.y) for item in load_waypoints(path)[1:]]


READERS = {
    "poi": places_in_poi,
    "csv": places_in_csv,
    "geojson": places_in_geojson,
    "kml": places_in_kml,
    "kmz": places_in_kmz,
    "gpx": places_in_gpx,
    "plan": places_in_plan,
    "waypoints": places_in_wpl,
}


@pytest.mark.parametrize("target_format", READERS)
@pytest.mark.parametrize("source_format", READERS)
def test_every_format_carries_the_places_to_every_other(
    ponte: Path, tmp_path: Path, source_format: str, target_format: str
) -> None:
    path_2016 = VECTORS / "path_2016.poi"
    source = tmp_path / f"source.{source_format}"
    target = tmp_path / f"target.{target_format}"
    convert(ponte, path_2016, source, "--altitude", "40")
    convert(ponte, source, target, "--altitude", "40")
    expected = places_in_poi(path_2016)
    assert READERS[source_format](source) == expected
    assert READERS[target_format](target) == expected


def test_pymavlink_reads_what_ponte_writes(ponte: Path, tmp_path: Path) -> None:
    target = tmp_path / "survey.waypoints"
    finished = convert(ponte, VECTORS / "survey.plan", target)
    told = [o for o in json_objects([ponte, "mission", "convert", VECTORS / "survey.plan", "--json"]) if o["type"] == "item"]
    home, *items = load_waypoints(target)
    assert (home.seq, home.x, home.y, home.z) == (0, 47.3977419, 8.545594, 487.989)
    assert len(items) == len(told)
    for item, expected in zip(items, told):
        assert (item.seq, item.command, item.frame) == (expected["number"], expected["command"], expected["frame"])
        assert item.autocontinue == (0 if expected.get("waits") else 1)
        parameters = [item.param1, item.param2, item.param3, item.param4, item.x, item.y, item.z]
        for got, wanted in zip(parameters, expected["parameters"]):
            assert math.isnan(got) if wanted == "NaN" else got == wanted
    lost = [line.split("lost: ")[1] for line in finished.stderr.splitlines() if "lost: " in line]
    assert lost == [
        "that items 3 to 6 are a pattern survey",
        "cruise speed",
        "hover speed",
        "kind of autopilot and airframe",
        "fence: circle 1",
        "fence: polygon 1",
        "rally: point 1",
    ]


def random_waypoint_file(path: Path, seed: int) -> None:
    """A mission as pymavlink writes it: home and items of many commands, each number with six decimals."""
    chance = random.Random(seed)
    loader = mavwp.MAVWPLoader()
    message = mavwp.mavutil.mavlink.MAVLink_mission_item_message

    def parameter(limit: float) -> float:
        return round(chance.uniform(-limit, limit), 6)

    loader.add(message(1, 1, 0, 0, 16, 1, 1, 0, 0, 0, 0, parameter(90), parameter(180), parameter(500)))
    for _ in range(chance.randint(1, 30)):
        frame, command = chance.choice([0, 3, 10]), chance.choice([16, 17, 18, 19, 20, 21, 22, 82, 178, 195, 201, 205, 206])
        numbers = [chance.choice([0, 1, -1, parameter(360)]) for _ in range(4)]
        loader.add(message(1, 1, 0, frame, command, 0, chance.randint(0, 1), *numbers, parameter(90), parameter(180), parameter(500)))
    loader.save(str(path))


@pytest.mark.parametrize("round_number", range(20))
@pytest.mark.parametrize("way", ["waypoints", "plan"])
def test_ponte_reads_what_pymavlink_writes(ponte: Path, tmp_path: Path, round_number: int, way: str) -> None:
    """Through WPL or .plan and back, pymavlink reads the same numbers; only the frame of what has no place may differ."""
    seed = seed_or(1) * 1000 + round_number
    source, between, target = tmp_path / "a.waypoints", tmp_path / f"b.{way}", tmp_path / "c.waypoints"
    random_waypoint_file(source, seed)
    convert(ponte, source, between)
    convert(ponte, between, target)
    wanted, got = load_waypoints(source), load_waypoints(target)
    assert len(got) == len(wanted), f"PONTE_SEED={seed}"
    placeless = {20, 178, 205, 206}
    for before, after in zip(wanted, got):
        fields = ["seq", "command", "autocontinue", "param1", "param2", "param3", "param4", "x", "y", "z"]
        if before.command not in placeless:
            fields.append("frame")
        assert {f: getattr(after, f) for f in fields} == {f: getattr(before, f) for f in fields}, f"PONTE_SEED={seed}"


def test_a_plan_keeps_everything_but_the_editors_marks(ponte: Path, tmp_path: Path) -> None:
    """The judge is JSON itself: what QGroundControl wrote is in what Ponte writes, to the last number."""
    target = tmp_path / "again.plan"
    finished = convert(ponte, VECTORS / "survey.plan", target)
    assert "lost" not in finished.stderr
    before = json.loads((VECTORS / "survey.plan").read_text(encoding="utf-8"))
    after = json.loads(target.read_text(encoding="utf-8"))
    assert after.pop("groundStation") == "ponte"
    before.pop("groundStation")
    assert after == before


BAD = {
    "empty.poi": (b"", "it is empty"),
    "binary.poi": (bytes(range(200, 240)), "no coordinates"),
    "swapped.csv": (b"lat,lon\n-122.4,37.8\n", "line 2: latitude is -122.4: expected -90 to 90; latitude and longitude look swapped"),
    "header.csv": (b"lat,lon\n", "line 1"),
    "broken.plan": (b'{"fileType": "Plan", "version": 1,\n"mission": ', "line 2"),
    "nothing.waypoints": (b"QGC WPL 110\n", "there is nothing in it"),
    "what.txt": (b"hello\n", "expected to be told it (--from)"),
    "mismatch.kml": (b"<kml>\n<Placemark>\n</kml>", "line 3"),
    "bare.kmz": (b"PK\x03\x04", "zip"),
    "no_altitude.csv": (b"lat,lon\n47,8\n", "line 2: point 1 has no altitude"),
}


@pytest.mark.parametrize("name", sorted(BAD))
def test_bad_input_ends_with_one_line_that_says_where_and_what(ponte: Path, tmp_path: Path, name: str) -> None:
    content, reason = BAD[name]
    path = tmp_path / name
    path.write_bytes(content)
    target = tmp_path / "target.plan"
    finished = run([ponte, "mission", "convert", path, target])
    assert (finished.returncode, finished.stdout.count("wrote")) == (1, 0), finished.stderr
    lines = finished.stderr.splitlines()
    assert len(lines) == 1, finished.stderr
    assert lines[0].startswith(f"{path}: ") and reason in lines[0] and "expected" in lines[0]
    assert not target.exists()


@pytest.mark.parametrize("arguments", [[], ["convert"], ["convert", "a.poi"], ["convert", "a.poi", "b.unknown"],
                                       ["convert", "a.poi", "b.kml", "--from", "exe"], ["no-such-verb"]])  # fmt: skip
def test_bad_usage_ends_with_status_2(ponte: Path, arguments: list[str]) -> None:
    finished = run([ponte, "mission", *arguments])
    assert finished.returncode == 2, finished.stderr
    assert finished.stdout == ""
