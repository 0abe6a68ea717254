"""Whether a plan keeps to everything asked of it, by other means than the search: dense samples of the filleted paths
that the missions, as the wire carries them, lead to."""

import math
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import numpy.typing as npt

from missions.environment.radars import exposed
from missions.errors import InputError
from missions.reference import Reference
from missions.scenario import Scenario
from planner import checks
from planner.formation_plan import FormationPlan, UavPlan

FloatArray = npt.NDArray[np.float64]

STEP_S = 0.5


@dataclass(frozen=True)
class UavReport:
    """What one UAV's path comes to. Heights and distances are the least, angles the largest along it.

    Attributes:
        wall_m: from any obstacle; infinite where there is none.
        separation_m: from any other UAV at the same time; infinite for a single one.
        radar_exposure_s: time within any radar's radius.
    """

    sysid: int
    name: str
    arrival_s: float
    clearance_m: float
    wall_m: float
    separation_m: float
    turn_deg: float
    climb_deg: float
    descent_deg: float
    leg_min_m: float
    leg_max_m: float
    airspeed_min_m_s: float
    airspeed_max_m_s: float
    power_share: float
    altitude_max_m: float
    radar_exposure_s: float


@dataclass(frozen=True)
class Violation:
    """What is wrong with one UAV's path: where, and by how much."""

    sysid: int
    text: str


@dataclass(frozen=True)
class VerificationReport:
    """Figures of every UAV, and what is wrong."""

    uavs: tuple[UavReport, ...]
    violations: tuple[Violation, ...]

    @property
    def at_fault(self) -> frozenset[int]:
        """sysids of UAVs with a violation."""
        return frozenset(violation.sysid for violation in self.violations)

    @property
    def radar_exposure_s(self) -> float:
        """Vehicle-seconds within radars."""
        return math.fsum(uav.radar_exposure_s for uav in self.uavs)


def require(report: VerificationReport) -> None:
    """Raise InputError with the first violation, and how many more there are."""
    if report.violations:
        more = f" (and {len(report.violations) - 1} more)" if len(report.violations) > 1 else ""
        raise InputError(f"plan: {report.violations[0].text}{more}")


def verify(plan: FormationPlan, scenario: Scenario) -> VerificationReport:
    """Check a plan against its scenario.

    Raises:
        InputError: the plan is for other vehicles than the scenario's, or a mission has no way to fly at all.
    """
    planned, wanted = sorted(uav.sysid for uav in plan.uavs), sorted(vehicle.sysid for vehicle in scenario.vehicles)
    if planned != wanted:
        raise InputError(f"plan: is for vehicles {planned}, scenario {scenario.name} has {wanted}; plan it again")
    vehicles = {vehicle.sysid: vehicle for vehicle in scenario.vehicles}
    references = plan.references(scenario)
    nearest, violations = _separations(plan, references, scenario)
    uavs = []
    for uav in plan.uavs:
        report, faults = _uav(uav, references[uav.sysid], nearest[uav.sysid], scenario)
        faults += checks.ends(uav.mission, references[uav.sysid], vehicles[uav.sysid], scenario)
        uavs.append(report)
        violations += [Violation(uav.sysid, f"{uav.name}: {fault}") for fault in faults]
    order = {uav.sysid: i for i, uav in enumerate(plan.uavs)}
    return VerificationReport(tuple(uavs), tuple(sorted(violations, key=lambda violation: order[violation.sysid])))


def _uav(uav: UavPlan, reference: Reference, nearest_m: float, scenario: Scenario) -> tuple[UavReport, list[str]]:
    path = checks.sample(uav.mission, reference, scenario)
    limits = scenario.limits
    clearance, faults = checks.clearance(path, scenario)
    wall, wall_faults = checks.walls(path, scenario)
    turn, turn_faults = checks.turns(path, limits.turn_max_deg)
    climb, descent, climb_faults = checks.climbs(path, limits.climb_max_deg)
    shortest, longest, leg_faults = checks.legs(path, limits.leg_min_m, limits.leg_max_m)
    slowest, fastest, share, speed_faults = checks.speeds(path, scenario)
    highest, box_faults = checks.box(path, scenario)
    faults += wall_faults + turn_faults + climb_faults + leg_faults + speed_faults + box_faults + checks.fillets(path)
    faults += checks.loiter(reference, scenario)
    positions = reference.positions(np.arange(0.0, reference.duration_s, STEP_S))
    report = UavReport(
        sysid=uav.sysid,
        name=uav.name,
        arrival_s=reference.duration_s,
        clearance_m=clearance,
        wall_m=wall,
        separation_m=nearest_m,
        turn_deg=turn,
        climb_deg=climb,
        descent_deg=descent,
        leg_min_m=shortest,
        leg_max_m=longest,
        airspeed_min_m_s=slowest,
        airspeed_max_m_s=fastest,
        power_share=share,
        altitude_max_m=highest,
        radar_exposure_s=STEP_S * int(np.count_nonzero(exposed(positions, scenario.environment.radars))),
    )
    return report, faults


def _separations(
    plan: FormationPlan, references: dict[int, Reference], scenario: Scenario
) -> tuple[dict[int, float], list[Violation]]:
    """Least distance of each UAV from any other at the same time, and the later UAV's violation of each pair.

    Between samples the relative motion counts as a straight line. A pair counts until the first of it arrives.
    """
    wanted = scenario.limits.separation_m - checks.TOLERANCE_M
    times = {sysid: np.append(np.arange(0.0, r.duration_s, STEP_S), r.duration_s) for sysid, r in references.items()}
    nearest = dict.fromkeys(references, math.inf)
    violations = []
    for first, second in combinations(plan.uavs, 2):
        t = min(times[first.sysid], times[second.sysid], key=lambda times: float(times[-1]))
        positions = references[first.sysid].positions(t)
        apart = positions - references[second.sysid].positions(t)
        moved = np.diff(apart, axis=0)
        squares = np.maximum(np.sum(moved**2, axis=1), 1e-12)
        part = np.clip(-np.sum(apart[:-1] * moved, axis=1) / squares, 0.0, 1.0)
        distances = np.linalg.norm(apart[:-1] + part[:, None] * moved, axis=1)
        k = int(np.argmin(distances))
        for uav in (first, second):
            nearest[uav.sysid] = min(nearest[uav.sysid], float(distances[k]))
        if distances[k] < wanted:
            text = (
                f"{second.name}: {distances[k]:.0f} m from {first.name} after {t[k]:.0f} s "
                f"at {checks.place(positions[k])}, limits.separation_m is {scenario.limits.separation_m:g}"
            )
            violations.append(Violation(second.sysid, text))
    return nearest, violations
