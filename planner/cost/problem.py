"""One UAV's planning problem as plain numbers: what the cost kernel knows."""

import math
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from missions.environment import Terrain, ground_height_m
from missions.environment.obstacles import wall_distances_m
from missions.reference.reference import fillet_radius_m
from missions.scenario import Scenario, VehicleModel
from planner.limits import airspeed_range_m_s, slope_range

FloatArray = npt.NDArray[np.float64]


class Margins(NamedTuple):
    """What the search keeps beyond the limits, so that the filleted path passes the verifier. Metres.

    Attributes:
        obstacle_m: the search sees sharp corners, the aircraft flies fillets: an arc passes its corner at
            R (1 / cos(turn / 2) - 1), 39 m inside at 60 degrees and the largest radius, 253 m.
        separation_m: two such cuts, and schedules whose speed steps are smoothed over some seconds.
        clearance_m: the ground under a cut corner (39 m at a slope of 0.4), the smoothing of altitude (up to 4 m),
            and what the kernel may miss between two samples (`planner.cost.terrain.DIP_M`).
    """

    obstacle_m: float = 45.0
    separation_m: float = 100.0
    clearance_m: float = 30.0


NO_MARGINS = Margins(0.0, 0.0, 0.0)
PLANNING_MARGINS = Margins()
TURN_MARGIN = math.radians(0.1)
SLOPE_MARGIN = 0.99
"""Part of the slope limits that the search may use: fillets shorten legs a little more or less than it thinks."""


class Bounds(NamedTuple):
    """Limits of a path: the box (1), the constraints (12), clearance, and the penalties of (5) and (9). SI, radians.

    `clearance_m` is wanted from `climb_out_m` along the path on; before, it ramps up from 0 at the origin. The flown
    length is at least `length_min_m`: a UAV with a short way takes a longer one to arrive with the others.
    """

    x_min_m: float
    x_max_m: float
    y_min_m: float
    y_max_m: float
    z_min_m: float
    z_max_m: float
    leg_min_m: float
    leg_max_m: float
    turn_max: float
    slope_min: float
    slope_max: float
    clearance_m: float
    climb_out_m: float
    length_min_m: float
    fillet_radius_m: float
    collision_penalty_km: float
    terrain_penalty_km: float
    terrain_constant_km2: float


class PathProblem(NamedTuple):
    """Where one UAV's path begins and ends and what it must mind. SI units, local frame.

    Attributes:
        origin_m, target_m: (3,).
        terrain: with peaks as an array.
        radars: (n, 5) x, y, z, radius, intensity.
        obstacles: (n, 5) x, y, radius, top, distance to keep from the wall.
        others: (n, m, 4) earlier UAVs' corners x, y, z and the part of the flight after which each is passed.
        separations_m: (n,) distance to keep from each of them at the same time.
        bounds: limits and penalties.
    """

    origin_m: FloatArray
    target_m: FloatArray
    terrain: Terrain
    radars: FloatArray
    obstacles: FloatArray
    others: FloatArray
    separations_m: FloatArray
    bounds: Bounds

    def corners_m(self, interior: Any) -> FloatArray:
        """(m, 3) corners of the path whose interior waypoints are given, flat or as (m - 2, 3)."""
        return np.vstack([self.origin_m, np.reshape(interior, (-1, 3)), self.target_m])


def path_problem(
    scenario: Scenario,
    vehicle: VehicleModel,
    others: FloatArray,
    expected_ground_speed_m_s: float,
    margins: Margins,
    length_min_m: float = 0.0,
) -> PathProblem:
    """The problem of one vehicle.

    A margin gives way where origin or target themselves stand closer than that, as scenarios may have it.

    Args:
        others: as in `PathProblem`, from `with_progress`.
        expected_ground_speed_m_s: at which the limits of climb are taken.
        margins: beyond the scenario's limits.
        length_min_m: least length flown.
    """
    origin, target = np.array(scenario.origin_m(vehicle)), np.array(scenario.target_m(vehicle))
    ends = np.array([origin, target])
    environment, limits = scenario.environment, scenario.limits
    terrain, area = environment.terrain.as_array(), environment.area

    obstacles = [
        (*o, _keep(limits.obstacle_margin_m, margins.obstacle_m, float(wall_distances_m(ends, o).min())))
        for o in environment.obstacles
    ]
    slope_min, slope_max = slope_range(scenario, expected_ground_speed_m_s)
    fastest = airspeed_range_m_s(scenario)[1] + math.hypot(*scenario.wind.forecast_m_s)
    bounds = Bounds(
        *area[:5],
        z_max_m=min(area.z_max_m, limits.altitude_max_m),
        leg_min_m=limits.leg_min_m,
        leg_max_m=limits.leg_max_m,
        turn_max=math.radians(limits.turn_max_deg) - TURN_MARGIN,
        slope_min=slope_min * SLOPE_MARGIN,
        slope_max=slope_max * SLOPE_MARGIN,
        clearance_m=_keep(
            limits.clearance_m, margins.clearance_m, target[2] - ground_height_m(target[0], target[1], terrain)
        ),
        climb_out_m=limits.climb_out_m,
        length_min_m=length_min_m,
        fillet_radius_m=fillet_radius_m(fastest),
        collision_penalty_km=limits.collision_penalty_km,
        terrain_penalty_km=limits.terrain_penalty_km,
        terrain_constant_km2=limits.terrain_constant_km2,
    )
    return PathProblem(
        origin_m=origin,
        target_m=target,
        terrain=terrain,
        radars=np.array(environment.radars, dtype=np.float64).reshape(-1, 5),
        obstacles=np.array(obstacles, dtype=np.float64).reshape(-1, 5),
        others=others,
        separations_m=separations_m(others, origin, target, limits.separation_m, margins),
        bounds=bounds,
    )


def separations_m(
    others: FloatArray, origin_m: FloatArray, target_m: FloatArray, limit_m: float, margins: Margins
) -> FloatArray:
    """(n,) distances that a UAV keeps from others, as in `PathProblem`, so that the limit of separation is kept."""
    at_ends = [min(math.dist(other[0, :3], origin_m), math.dist(other[-1, :3], target_m)) for other in others]
    return np.array([_keep(limit_m, margins.separation_m, nearest) for nearest in at_ends], dtype=np.float64)


def _keep(limit_m: float, margin_m: float, at_ends_m: float) -> float:
    return max(limit_m, min(limit_m + margin_m, at_ends_m - 1e-3))
