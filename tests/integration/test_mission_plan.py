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
NAV_WAYPOINT, NAV_LAND, NAV_TAKEOFF, NAV_DELAY, DO_SET_CAM_TRIGG_DIST = 16, 21, 22, 93, 206


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
    assert reasons[2] == "the endurance is spent on others"
    assert reasons[4].endswith("beyond the endurance")


def test_the_same_seed_gives_the_same_bytes(ponte: Path, tmp_path: Path) -> None:
    outputs = [tmp_path / "a.plan", tmp_path / "b.plan"]
    for output in outputs:
        plan(ponte, POINTS_2016, "--tries", 2000, "--seconds", 3600, "--output", output)
    assert outputs[0].read_bytes() == outputs[1].read_bytes()


def test_vehicles_that_meet_are_kept_apart_and_each_has_its_file(ponte: Path, tmp_path: Path) -> None:
    output = tmp_path / "mission.waypoints"
    lines = plan(
        ponte, POINTS_2016, "--vehicle", "speed=8", "--vehicle", "speed=8", "--objective", "longest", "--output", output
    )
    assert lines[0]["conflict"] == [1, 2]  # both start at the same place
    vehicles = lines[1:]
    assert vehicles[0]["wait_s"] == 0 and vehicles[1]["wait_s"] > 0
    commands = [[item[0] for item in items_of(tmp_path / f"mission-{number}.waypoints")] for number in (1, 2)]
    assert NAV_DELAY in commands[1] and NAV_DELAY not in commands[0]


def test_routes_that_cross_are_in_layers_or_wait(ponte: Path, tmp_path: Path) -> None:
    points = tmp_path / "points.csv"
    points.write_text("latitude,longitude,sensor_quality\n0.005,0.005,0.9\n0,0.005,0\n")
    arguments = [points, "--end", "last-point", "--vehicle", "start=0,0;quality=1"]
    arguments += ["--vehicle", "start=0.005,0;quality=0", "--objective", "longest"]
    conflict, first, second = plan(ponte, *arguments)
    assert conflict["conflict"] == [1, 2] and math.isclose(conflict["latitude"], 0.0025, abs_tol=0.001)
    assert (first["points"], second["points"]) == ([1], [2])
    assert (second["added_altitude_m"], second["wait_s"]) == (10, 0)
    _, _, second = plan(ponte, *arguments, "--separate-by", "time")
    assert second["added_altitude_m"] == 0 and second["wait_s"] >= 15


def test_a_fixed_wing_needs_longer_for_its_turns(ponte: Path, tmp_path: Path) -> None:
    output = tmp_path / "mission.waypoints"
    (turns_on_spot,) = plan(ponte, POINTS_2016, "--speed", 15)
    (turns_wide,) = plan(ponte, POINTS_2016, "--speed", 15, "--turn-radius", 60, "--output", output)
    assert sorted(turns_wide["points"]) == list(range(1, 9))
    assert turns_on_spot["length_m"] + 30 < turns_wide["length_m"] < 3 * turns_on_spot["length_m"]
    assert len(items_of(output)) > len(WAYPOINTS_2016) + 3  # also where turns are over


AREA = [[8.5450, 47.3970], [8.5480, 47.3970], [8.5480, 47.3985], [8.5465, 47.3978], [8.5450, 47.3985]]
CAMERA = "sensor=13.2x8.8;focal=8.8;pixels=5472"


def area_file(folder: Path) -> Path:
    path = folder / "area.geojson"
    path.write_text(json.dumps({"type": "Polygon", "coordinates": [[*AREA, AREA[0]]]}))
    return path


def test_a_survey_flies_every_line_and_triggers_the_camera_by_distance(ponte: Path, tmp_path: Path) -> None:
    output = tmp_path / "survey.plan"
    arguments = ["--survey", area_file(tmp_path), "--camera", CAMERA, "--altitude", 50, "--output", output]
    (vehicle,) = plan(ponte, *arguments)
    assert sorted(vehicle["lines"]) == list(range(1, len(vehicle["lines"]) + 1))
    items = json.loads(output.read_text())["mission"]["items"]
    spacings = [item["params"][0] for item in items if item["command"] == DO_SET_CAM_TRIGG_DIST]
    # 50 m above ground 75 m by 50 m are seen; 70 % of 50 m overlap.
    assert spacings == pytest.approx([15, 0] * len(vehicle["lines"]))
    (denser,) = plan(ponte, *arguments, "--side-overlap", 85)
    assert len(denser["lines"]) > 1.5 * len(vehicle["lines"])


def test_a_survey_is_shared_by_vehicles_and_by_the_resolution_that_is_asked(ponte: Path, tmp_path: Path) -> None:
    arguments = ["--survey", area_file(tmp_path), "--camera", CAMERA, "--gsd", 1.0, "--objective", "longest"]
    vehicles = [
        line
        for line in plan(ponte, *arguments, "--vehicle", "start=47.397,8.545", "--vehicle", "start=47.397,8.548")
        if "vehicle" in line
    ]
    lines = [line for vehicle in vehicles for line in vehicle["lines"]]
    assert sorted(lines) == list(range(1, len(lines) + 1))
    assert all(vehicle["lines"] for vehicle in vehicles)


def test_a_corridor_is_flown_along_both_ways(ponte: Path, tmp_path: Path) -> None:
    line = tmp_path / "river.geojson"
    line.write_text(json.dumps({"type": "LineString", "coordinates": AREA[:3]}))
    (vehicle,) = plan(ponte, "--corridor", line, "--width", 60, "--camera", CAMERA)
    assert len(vehicle["lines"]) == 2 * 4  # two legs of 60 m, at 60 m * 30 % = 18 m


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
        ([], 2, "POINTS"),
        (["--survey", POINTS_2016, "--camera", "sensor=13.2x8.8;focal=8.8;pixels=5472"], 1, "no polygon"),
        (["--survey", POINTS_2016], 2, "--camera"),
        (["--survey", POINTS_2016, "--camera", "lens=3"], 2, "lens"),
        (["--corridor", POINTS_2016, "--camera", "sensor=13.2x8.8;focal=8.8;pixels=5472"], 2, "--width"),
    ],
)
def test_what_cannot_be_done_is_refused(ponte: Path, arguments: list, status: int, words: str) -> None:
    finished = run([ponte, "mission", "plan", *map(str, arguments), "--quiet"])
    assert finished.returncode == status, finished.stderr
    assert any(word in finished.stderr for word in words.split("|")), finished.stderr
