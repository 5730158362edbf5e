"""`ponte mission plan` from the command line: the mission of 2016, a better order, and what bad input gets."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from programs import REPOSITORY, run

POINTS_2016 = REPOSITORY / "tests" / "vectors" / "missions" / "path_2016.poi"
# The mission that was flown in 2016: take-off, eight waypoints, land.
WAYPOINTS_2016 = [
    (-30.06898, -51.12179), (-30.06990, -51.12096), (-30.06990, -51.12096), (-30.07020, -51.12475),
    (-30.06775, -51.12594), (-30.06775, -51.12594), (-30.06775, -51.12594), (-30.06610, -51.12431),
]  # fmt: skip
LANDING_2016 = (-30.06711, -51.12207)
NAV_WAYPOINT, NAV_RETURN, NAV_LAND, NAV_TAKEOFF = 16, 20, 21, 22


def plan(ponte: Path, *arguments: object) -> list[dict]:
    finished = run([ponte, "mission", "plan", *map(str, arguments), "--json"])
    assert finished.returncode == 0, finished.stderr
    return [json.loads(line) for line in finished.stdout.splitlines()]


def items_of(waypoints: Path) -> list[tuple[int, float, float, float]]:
    """Command, latitude, longitude and altitude of each item but home."""
    rows = [line.split("\t") for line in waypoints.read_text().splitlines()[1:]]
    return [(int(row[3]), float(row[8]), float(row[9]), float(row[10])) for row in rows[1:]]


def landing() -> str:
    return f"end={LANDING_2016[0]},{LANDING_2016[1]}"


def test_the_given_order_is_the_mission_of_2016(ponte: Path, tmp_path: Path) -> None:
    output = tmp_path / "mission.waypoints"
    plan(ponte, POINTS_2016, "--order", "given", "--vehicle", landing(), "--output", output)
    assert items_of(output) == [
        (NAV_TAKEOFF, *WAYPOINTS_2016[0], 40),
        *((NAV_WAYPOINT, *place, 40) for place in WAYPOINTS_2016),
        (NAV_LAND, *LANDING_2016, 0),
    ]


def test_another_order_is_shorter_than_that_of_2016(ponte: Path, tmp_path: Path) -> None:
    """The places of 2016, from the take-off to the one where it landed, when any may be the last."""
    points = tmp_path / "points.csv"
    places = [*WAYPOINTS_2016, LANDING_2016]
    points.write_text("latitude,longitude\n" + "".join(f"{a},{b}\n" for a, b in places))
    (given,) = plan(ponte, points, "--end", "last-point", "--order", "given")
    (best,) = plan(ponte, points, "--end", "last-point")
    assert sorted(best["points"]) == given["points"] == list(range(1, 10))
    assert best["length_m"] < given["length_m"] - 10


def test_a_point_in_a_zone_is_left_out_with_its_line(ponte: Path, tmp_path: Path) -> None:
    points = tmp_path / "points.csv"
    points.write_text("latitude,longitude\n-30.0670,-51.1220\n-30.0680,-51.1230\n")
    zone = tmp_path / "zone.geojson"
    ring = [[-51.1235, -30.0685], [-51.1225, -30.0685], [-51.1225, -30.0675], [-51.1235, -30.0675]]
    zone.write_text(
        json.dumps(
            {
                "type": "Feature",
                "properties": {"fence": "exclusion"},
                "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]},
            }
        )
    )
    vehicle, left = plan(ponte, points, "--fence", zone)
    assert vehicle["points"] == [1]
    assert left == {"unvisited": 2, "reason": "lies where the zones do not allow to fly"}


def test_endurance_leaves_out_what_matters_least(ponte: Path, tmp_path: Path) -> None:
    points = tmp_path / "points.csv"
    points.write_text("latitude,longitude,priority\n0.000,0.001,1\n0.004,0,1\n0,0.004,5\n0,0.2,9\n")
    vehicle, *left = plan(
        ponte, points, "--vehicle", "start=0,0;endurance=200;speed=8", "--reserve", 20, "--vertical-speed", 4
    )
    assert set(vehicle["points"]) == {1, 3}
    assert vehicle["time_s"] <= 160 and math.isclose(vehicle["margin_s"], 200 - vehicle["time_s"])
    reasons = {line["unvisited"]: line["reason"] for line in left}
    assert reasons[2] == "the endurance is spent on other points"
    assert reasons[4].endswith("beyond the endurance")


def test_the_same_seed_gives_the_same_bytes(ponte: Path, tmp_path: Path) -> None:
    outputs = [tmp_path / "a.plan", tmp_path / "b.plan"]
    for output in outputs:
        plan(ponte, POINTS_2016, "--tries", 2000, "--seconds", 3600, "--output", output)
    assert outputs[0].read_bytes() == outputs[1].read_bytes()


def test_routes_that_cross_are_in_layers_and_each_vehicle_has_its_file(ponte: Path, tmp_path: Path) -> None:
    output = tmp_path / "mission.waypoints"
    vehicles = plan(
        ponte, POINTS_2016, "--vehicle", "speed=8", "--vehicle", "speed=8", "--objective", "longest", "--output", output
    )
    assert sorted(vehicle["layer"] for vehicle in vehicles) == [0, 1]
    heights = [
        {item[3] for item in items_of(tmp_path / f"mission-{number}.waypoints") if item[0] == NAV_WAYPOINT}
        for number in (1, 2)
    ]
    assert sorted(map(sorted, heights)) == [[40], [50]]


def test_the_map_is_whole_in_itself(ponte: Path, tmp_path: Path) -> None:
    page = tmp_path / "map.html"
    plan(ponte, POINTS_2016, "--output-html", page)
    text = page.read_text()
    assert text.count("<circle") == 9 and "<polyline" in text
    assert "src=" not in text and "href=" not in text


@pytest.mark.parametrize(
    "arguments, status, words",
    [
        ([POINTS_2016, "--vehicle", "sped=3"], 2, "sped"),
        ([POINTS_2016, "--vehicle", "start=95,0"], 2, "95"),
        ([POINTS_2016, "--wind", "gale"], 2, "gale"),
        ([POINTS_2016, "--order", "given", "--vehicle", "", "--vehicle", ""], 2, "one vehicle"),
        ([POINTS_2016, "--altitude", "500"], 1, "--altitude-max"),
        ([POINTS_2016, "--order", "given", "--endurance", "60"], 1, "endurance|has"),
        ([POINTS_2016.with_name("survey.plan")], 1, "no points"),
        (["no-such-file.csv"], 1, "no-such-file.csv"),
    ],
)
def test_what_cannot_be_done_is_refused(ponte: Path, arguments: list, status: int, words: str) -> None:
    finished = run([ponte, "mission", "plan", *map(str, arguments), "--quiet"])
    assert finished.returncode == status, finished.stderr
    assert any(word in finished.stderr for word in words.split("|")), finished.stderr
