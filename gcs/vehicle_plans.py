"""All that each vehicle of a run can be given: its mission, with the fence and the rally point that go with it."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.fence import rally_items
from missions.landing import landings, with_landing
from missions.reference import Reference
from missions.safe_return import safe_return_altitude_m
from missions.scenario import Scenario
from missions.surroundings_fence import surroundings_fence
from missions.vehicle_plan import Plan
from planner.formation_plan import FormationPlan

FloatArray = npt.NDArray[np.float64]

_STEP_S = 1.0
_STEPS_PER_LINE = 4
"""A straight line home is looked at from one point in so many."""
_CIRCLE_POINTS = 72


@dataclass(frozen=True)
class VehiclePlan:
    """What one vehicle is given, and what its operator is to know.

    Attributes:
        sysid, name: of the vehicle.
        plan: altitudes AMSL, home as item 0; in no autopilot's dialect yet.
        unfenced: such as "radars[1]": what its way comes too near to for an exclusion fence.
        return_height_m: above home; from there it comes home in a straight line from anywhere on its way.
        farthest_m: from home, of all its way.
    """

    sysid: int
    name: str
    plan: Plan
    unfenced: tuple[str, ...]
    return_height_m: float
    farthest_m: float


def vehicle_plans(scenario: Scenario, formation: FormationPlan, *, landing: bool = False) -> list[VehiclePlan]:
    """What each vehicle is given, in the plan's order.

    Args:
        scenario: whose surroundings count.
        formation: its plan.
        landing: whether vehicles land below their targets, instead of circling there.

    Raises:
        InputError: a landing is wanted where there is none.
    """
    frame, environment, limits = scenario.frame, scenario.environment, scenario.limits
    references = formation.references(scenario)
    down = landings(scenario, formation.missions) if landing else {}
    plans = []
    for uav in formation.uavs:
        mission, home = uav.mission, uav.mission.home
        way_m = _way_m(references[uav.sysid])
        if uav.sysid in down:
            mission = with_landing(mission, down[uav.sysid], frame)
            way_m = np.vstack([way_m, down[uav.sysid].way_m()])
        fence, unfenced = surroundings_fence(environment, frame, way_m)
        home_m = (*frame.from_e7(home.lat_e7, home.lon_e7), home.alt_m - frame.alt_m)
        starts_m = way_m[::_STEPS_PER_LINE]
        safe_m = safe_return_altitude_m(home_m, starts_m, environment, limits.clearance_m, limits.obstacle_margin_m)
        height_m = float(math.ceil(safe_m - home_m[2]))
        rally = rally_items([(home.lat_e7, home.lon_e7, height_m)])
        farthest_m = float(np.hypot(*(way_m[:, :2] - home_m[:2]).T).max())
        plans.append(VehiclePlan(uav.sysid, uav.name, Plan(mission, fence, rally), unfenced, height_m, farthest_m))
    return plans


def _way_m(reference: Reference) -> FloatArray:
    """(n, 3) points of a reference and of its loiter, local frame."""
    flown = reference.positions(np.append(np.arange(0.0, reference.duration_s, _STEP_S), reference.duration_s))
    angles = np.linspace(0.0, 2.0 * math.pi, _CIRCLE_POINTS, endpoint=False)
    radius_m = abs(reference.loiter_radius_m)
    x, y, _ = reference.target_m
    height = np.full(_CIRCLE_POINTS, reference.loiter_z_m)
    loiter = np.column_stack([x + radius_m * np.cos(angles), y + radius_m * np.sin(angles), height])
    return np.vstack([flown, loiter])
