"""Writes the generated set of heterogeneous multi-depot problems to generated.json, with a lower bound of each.

Stops lie in a square of 2 km; vehicles differ in speed, sensor and depot, and come home. The least sum of flight times is
wanted. The bound: all depots in one node, each leg at the speed of the fastest vehicle whose sensor is good enough for
both of its ends, and then the Lagrangian bound of Held and Karp (1971): each stop has two legs, and the legs connect all.
"""

import json
import math
import random
from pathlib import Path

SIZES = [(30, 2), (50, 3), (75, 3), (100, 4), (100, 6), (150, 5)]
SUBGRADIENT_STEPS = 400


def generate(number, stops, vehicles):
    draw = random.Random(number)
    return {
        "name": f"hmd{number}-n{stops}-m{vehicles}",
        "stops": [
            {"x": draw.randrange(2000), "y": draw.randrange(2000), "quality": draw.choice([0, 0, 0, 0.5, 1])}
            for _ in range(stops)
        ],
        # The last vehicle has the best sensor, so every stop can be visited.
        "vehicles": [
            {
                "x": draw.randrange(2000),
                "y": draw.randrange(2000),
                "speed": draw.choice([5, 8, 12, 15]),
                "quality": 1 if i == vehicles - 1 else draw.choice([0, 0.5, 1]),
            }
            for i in range(vehicles)
        ],
    }


def least_times(problem):
    """Seconds between the stops, and in the last row those from the nearest depot."""
    stops, vehicles = problem["stops"], problem["vehicles"]

    def between(a, b, quality):
        return min(
            math.hypot(a["x"] - b["x"], a["y"] - b["y"]) / v["speed"] for v in vehicles if v["quality"] >= quality
        )

    times = [[between(a, b, max(a["quality"], b["quality"])) for b in stops] for a in stops]
    times.append(
        [
            min(
                math.hypot(v["x"] - a["x"], v["y"] - a["y"]) / v["speed"]
                for v in vehicles
                if v["quality"] >= a["quality"]
            )
            for a in stops
        ]
    )
    return times


def cheapest_structure(times, prices, vehicles):
    """Cost and degrees of the cheapest tree over the stops and the common depot, and for each route a last leg home.

    A plan is such a tree and one more leg to the depot for each vehicle that flies, so it cannot cost less. Legs whose
    prices are negative count as flown by as many vehicles as there are.
    """
    count = len(prices)
    depot = times[count]
    cost, degree = 0.0, [0] * count
    reach = [(depot[i] + prices[i], -1) for i in range(count)]
    rest = set(range(count))
    while rest:
        node = min(rest, key=lambda i: reach[i][0])
        price, parent = reach[node]
        rest.remove(node)
        cost += price
        degree[node] += 1
        if parent >= 0:
            degree[parent] += 1
        for other in rest:
            price = times[node][other] + prices[node] + prices[other]
            if price < reach[other][0]:
                reach[other] = (price, node)
    homeward = sorted((depot[i] + prices[i], i) for i in range(count))[:vehicles]
    for at, (price, node) in enumerate(homeward):
        if at == 0 or price < 0:
            cost += price
            degree[node] += 1
    return cost, degree


def lower_bound(problem):
    times = least_times(problem)
    count = len(problem["stops"])
    prices = [0.0] * count
    best = 0.0
    step = cheapest_structure(times, prices, len(problem["vehicles"]))[0] / count / 4
    for _ in range(SUBGRADIENT_STEPS):
        cost, degree = cheapest_structure(times, prices, len(problem["vehicles"]))
        best = max(best, cost - 2 * sum(prices))
        prices = [price + step * (d - 2) for price, d in zip(prices, degree)]
        step *= 0.985
    return best


def main():
    problems = [generate(number, *size) for number, size in enumerate(SIZES, 1)]
    for problem in problems:
        problem["lower_bound"] = round(lower_bound(problem), 3)
    text = ",\n".join(json.dumps(problem) for problem in problems)
    (Path(__file__).parent / "generated.json").write_text(f"[\n{text}\n]\n")


if __name__ == "__main__":
    main()
