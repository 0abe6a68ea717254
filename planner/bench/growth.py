"""How planning time grows with the number of UAVs: fields of many that fly side by side through the same threats."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from missions.scenario import Scenario, load_scenario
from missions.scenario.places import AreaModel, ObstacleModel, RadarModel
from planner.plan import plan

NUMBERS = (10, 20, 50, 100)
LANE_M = 1000.0
"""Between neighbouring origins: each of many UAVs has neighbours that its path may meet."""
EVERY_M = 18000.0
"""The radars and buildings of `radars` stand again so much further north, for as long as there are UAVs."""
SOUTH_M = 4000.0
"""Of the first origin; the threats' own belt begins there, too."""
REACH_M, DRIFT_M, HEIGHT_M = (27000.0, 31000.0), (-300.0, 300.0), (2200.0, 2800.0)
"""How far targets lie east and north of their origins, and how high."""


@dataclass(frozen=True)
class Growth:
    """Planning of one field.

    Attributes:
        uavs: how many.
        cpu_s, wall_s: of the whole plan, verification included, without compilation.
    """

    uavs: int
    cpu_s: float
    wall_s: float


def field(uavs: int, seed: int = 1) -> Scenario:
    """The scenario `radars` made so wide that many UAVs cross it, at most 250, each in a lane of its own."""
    radars = load_scenario("radars")
    rng = np.random.default_rng([seed, uavs])
    north_m = SOUTH_M + uavs * LANE_M + 8000.0
    belts = EVERY_M * np.arange(int(north_m // EVERY_M) + 1)
    vehicles = []
    for i in range(uavs):
        y = SOUTH_M + i * LANE_M
        x, drift, z = rng.uniform(*REACH_M), rng.uniform(*DRIFT_M), rng.uniform(*HEIGHT_M)
        vehicles.append(
            radars.vehicles[0].model_copy(
                update={
                    "name": f"U{i + 1}",
                    "sysid": i + 1,
                    "origin": (0.0, y, 0.0),
                    "target": (float(x), float(y + drift), float(z)),
                }
            )
        )
    data = radars.model_dump() | {
        "name": f"field-{uavs}",
        "area": AreaModel(x_m=(0.0, 40000.0), y_m=(0.0, north_m), z_m=(0.0, 4000.0)).model_dump(),
        "radars": [_moved(radar, float(y)) for y in belts for radar in radars.radars],
        "obstacles": [_moved(obstacle, float(y)) for y in belts for obstacle in radars.obstacles],
        "vehicles": [vehicle.model_dump() for vehicle in vehicles],
    }
    return Scenario.model_validate(data)


def _moved(thing: RadarModel | ObstacleModel, north_m: float) -> dict[str, Any]:
    """The same thing further north."""
    return thing.model_dump() | {"y_m": thing.y_m + north_m}


def measure_growth(numbers: Sequence[int], told: Callable[[], None]) -> list[Growth]:
    """Plan a field of each number of UAVs, telling of each."""
    found = []
    plan(field(2))  # compiled, and cached
    for uavs in numbers:
        scenario = field(uavs)
        start, cpu = time.perf_counter(), time.process_time()
        made = plan(scenario)
        spent_s = time.process_time() - cpu - made.compile_s
        found.append(Growth(uavs, spent_s, time.perf_counter() - start - made.compile_s))
        told()
    return found


def exponent(growths: Sequence[Growth]) -> float:
    """p of the power law n^p that fits the CPU times best, in logarithms."""
    n, cpu_s = np.array([(growth.uavs, growth.cpu_s) for growth in growths]).T
    return float(np.polyfit(np.log(n), np.log(cpu_s), 1)[0])
