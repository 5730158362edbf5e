"""Benchmarks of the planner: solvers against known optima, best known values and bounds, beside OR-Tools.

Limits are seconds of processor time, also for OR-Tools (PyPI `ortools`), which solves each longest-route problem in the
same run; where it is not installed it is listed as skipped.
"""

import json
import math
import re
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

from figure import Figure

INSTANCES = Path(__file__).parent / "planning"
PEER_SECONDS = 10
# The figures that the issue sets targets for: (pattern of the case, target, whether more is better).
TARGETS = [
    (r"optimum 1 s$", 9, True),
    (r"worst gap 5 s$", 0.3, False),
    (r"^longest route mean gap 10 s$", 0.5, False),
]
LONGEST_CASE = re.compile(r"^(?P<name>\w+)-m(?P<vehicles>\d) gap 10 s$")


def best_known() -> dict[tuple[str, int], float]:
    """The best known longest routes, from the table in planning.cpp."""
    source = (Path(__file__).parent / "planning.cpp").read_text()
    table = source.split("longest_routes[] =")[1].split(";")[0]
    return {(n, int(m)): float(v) for n, m, v in re.findall(r'\{"(\w+)", (\d), ([\d.]+)\}', table)}


def coordinates(name: str) -> list[tuple[float, float]]:
    text = (INSTANCES / "tsplib" / f"{name}.tsp").read_text()
    rows = [line.split() for line in text.splitlines()]
    return [(float(row[1]), float(row[2])) for row in rows if len(row) == 3 and row[0].isdigit()]


def or_tools_longest(name: str, vehicles: int) -> float | None:
    """The longest route that OR-Tools finds; nothing when it is not installed."""
    try:
        from ortools.constraint_solver import pywrapcp, routing_enums_pb2
    except ImportError:
        return None
    places = coordinates(name)
    scale = 1000
    distances = [[round(scale * math.dist(a, b)) for b in places] for a in places]
    manager = pywrapcp.RoutingIndexManager(len(places), vehicles, 0)
    routing = pywrapcp.RoutingModel(manager)

    def distance(a: int, b: int) -> int:
        return distances[manager.IndexToNode(a)][manager.IndexToNode(b)]

    callback = routing.RegisterTransitCallback(distance)
    routing.SetArcCostEvaluatorOfAllVehicles(callback)
    routing.AddDimension(callback, 0, scale * 1_000_000, True, "length")
    # A coefficient of 100 makes the longest route govern the cost, as OR-Tools' own documentation does.
    routing.GetDimensionOrDie("length").SetGlobalSpanCostCoefficient(100)
    parameters = pywrapcp.DefaultRoutingSearchParameters()
    parameters.first_solution_strategy = routing_enums_pb2.FirstSolutionStrategy.PATH_CHEAPEST_ARC
    parameters.local_search_metaheuristic = routing_enums_pb2.LocalSearchMetaheuristic.GUIDED_LOCAL_SEARCH
    parameters.time_limit.seconds = 3600  # It counts wall-clock time; the limit below counts processor time.
    start = time.thread_time()
    limit = routing.solver().CustomLimit(lambda: time.thread_time() - start > PEER_SECONDS)
    routing.AddSearchMonitor(limit)
    solution = routing.SolveWithParameters(parameters)
    if solution is None:
        return math.inf
    longest = 0.0
    for vehicle in range(vehicles):
        length, index = 0.0, routing.Start(vehicle)
        while not routing.IsEnd(index):
            following = solution.Value(routing.NextVar(index))
            length += math.dist(places[manager.IndexToNode(index)], places[manager.IndexToNode(following)])
            index = following
        longest = max(longest, length)
    return longest


def judged(case: str, value: float, unit: str, peer: str | None, peer_value: float | None) -> Figure:
    for pattern, target, at_least in TARGETS:
        if re.search(pattern, case):
            return Figure("planning", case, value, unit, peer, peer_value, target, at_least)
    return Figure("planning", case, value, unit, peer, peer_value)


def figures(programs: Path) -> Iterator[Figure]:
    known = best_known()
    peer_gaps: list[float] = []
    command = [programs / "bench_planning", INSTANCES]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as program:
        assert program.stdout is not None
        for figure in map(json.loads, program.stdout):
            peer, peer_value = None, None
            if found := LONGEST_CASE.match(figure["case"]):
                key = found["name"], int(found["vehicles"])
                longest = or_tools_longest(*key)
                peer = "OR-Tools" if longest is not None else "OR-Tools (skipped)"
                if longest is not None:
                    peer_value = 100 * (longest / known[key] - 1)
                    peer_gaps.append(peer_value)
            elif figure["case"] == "longest route mean gap 10 s":
                peer = "OR-Tools" if peer_gaps else "OR-Tools (skipped)"
                peer_value = sum(peer_gaps) / len(peer_gaps) if peer_gaps else None
            yield judged(figure["case"], figure["value"], figure["unit"], peer, peer_value)
    if program.returncode != 0:
        raise subprocess.CalledProcessError(program.returncode, command)
