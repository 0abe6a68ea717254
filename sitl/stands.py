"""Where the vehicles of a simulated swarm stand: the scenario's own, and more beside them."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from missions.environment import ground_height_m
from missions.environment.obstacles import wall_distances_m
from missions.errors import InputError
from missions.scenario import Scenario

LAST_SYSID = 250
"""Higher system ids are ground stations' (255 by custom)."""
SPACING_LEAST_M = 100.0


class Stand(NamedTuple):
    """One vehicle: its system id, its name, and its home, (x, y, z) in the local frame."""

    sysid: int
    name: str
    home_m: tuple[float, float, float]


def stands(scenario: Scenario, count: int | None = None, sysid_base: int | None = None) -> list[Stand]:
    """The first `count` vehicles of a scenario. Where it has fewer, more stand around them on the ground, on a grid.

    The grid's spacing is the scenario's `limits.separation_m`, at least 100 m; its places lie in the area, off the
    obstacles, and that far from the scenario's own vehicles. System ids go on after the scenario's largest.

    Args:
        scenario: whose vehicles they are.
        count: of vehicles; as many as the scenario has unless given.
        sysid_base: system id of the first; those of the others shift alike.

    Raises:
        InputError: there is no room for so many, or no system ids.
    """
    count = len(scenario.vehicles) if count is None else count
    own = [Stand(of.sysid, of.name, scenario.origin_m(of)) for of in scenario.vehicles[:count]]
    last = max(stand.sysid for stand in own)
    places = _places(scenario, [stand.home_m for stand in own]) if count > len(own) else iter(())
    more = [
        Stand(last + i, f"more{i}", place) for i, place in zip(range(1, count - len(own) + 1), places, strict=False)
    ]
    if len(own) + len(more) < count:
        raise InputError(f"--count {count}: there is room for {len(own) + len(more)} vehicles in {scenario.name}")
    shift = 0 if sysid_base is None else sysid_base - own[0].sysid
    everyone = [stand._replace(sysid=stand.sysid + shift) for stand in own + more]
    first, last = min(stand.sysid for stand in everyone), max(stand.sysid for stand in everyone)
    if first < 1 or last > LAST_SYSID:
        raise InputError(
            f"{count} vehicles would have the system ids {first} to {last}, and there are 1 to {LAST_SYSID}; "
            "choose a smaller --count or another --sysid-base"
        )
    return everyone


def _places(scenario: Scenario, taken_m: list[tuple[float, float, float]]) -> Iterator[tuple[float, float, float]]:
    """Free places on the grid, those nearest to the middle of the taken ones first."""
    environment, limits = scenario.environment, scenario.limits
    area = environment.area
    spacing_m = max(limits.separation_m, SPACING_LEAST_M)
    taken = np.array(taken_m)[:, :2]
    middle = taken.mean(axis=0)
    x = np.arange(area.x_min_m, area.x_max_m, spacing_m)
    y = np.arange(area.y_min_m, area.y_max_m, spacing_m)
    grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    nearest_first = np.argsort(np.hypot(*(grid - middle).T), kind="stable")
    for x_m, y_m in grid[nearest_first].tolist():
        z_m = ground_height_m(x_m, y_m, environment.terrain)
        here = np.array([x_m, y_m, z_m])
        if (
            min(math.dist((x_m, y_m), other) for other in taken) >= spacing_m
            and z_m <= min(area.z_max_m, limits.altitude_max_m)
            and all(wall_distances_m(here, one) >= limits.obstacle_margin_m for one in environment.obstacles)
        ):
            yield x_m, y_m, z_m
