"""What a flight came close to: the ground, obstacles, radars."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.environment import ground_heights_m
from missions.environment.obstacles import wall_distances_m
from missions.environment.radars import exposed
from missions.environment.terrain import AIRBORNE_M
from missions.scenario import Scenario
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Surroundings:
    """One vehicle's least distances once airborne; None where there is nothing to be distant from.

    Attributes:
        clearance_m: above ground.
        clearance_margin_m: above what limits.clearance_m asks for, which grows from 0 over limits.climb_out_m.
        wall_m: from any obstacle.
        radar_exposure_s: time within any radar's radius.
    """

    clearance_m: float | None
    clearance_margin_m: float | None
    wall_m: float | None
    radar_exposure_s: float


def airborne_row(positions_m: FloatArray, scenario: Scenario) -> int | None:
    """The first row of (n, 3) that is `AIRBORNE_M` above ground; None when there is none."""
    above = positions_m[:, 2] - ground_heights_m(positions_m[:, 0], positions_m[:, 1], scenario.environment.terrain)
    high = np.flatnonzero(above >= AIRBORNE_M)
    return int(high[0]) if len(high) else None


def surroundings(positions_m: FloatArray, scenario: Scenario) -> Surroundings:
    """Measure one vehicle's flight, (n_tick, 3) from its launch; NaN where it is not known."""
    flown = positions_m[np.isfinite(positions_m[:, 0])]
    environment, limits = scenario.environment, scenario.limits
    first = airborne_row(flown, scenario)
    if first is None:
        return Surroundings(None, None, None, 0.0)
    above = flown[:, 2] - ground_heights_m(flown[:, 0], flown[:, 1], environment.terrain)
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(flown[:, :2], axis=0).T))])
    wanted = limits.clearance_m * np.minimum(1.0, along / limits.climb_out_m)
    airborne = slice(first, None)
    walls = [float(wall_distances_m(flown[airborne], obstacle).min()) for obstacle in environment.obstacles]
    return Surroundings(
        clearance_m=float(above[airborne].min()),
        clearance_margin_m=float((above - wanted)[airborne].min()),
        wall_m=min(walls, default=None),
        radar_exposure_s=TICK_S * int(np.count_nonzero(exposed(flown[airborne], environment.radars))),
    )
