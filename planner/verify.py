"""Whether a plan keeps to everything asked of it, by other means than the search: on the filleted paths that the
missions, as the wire carries them, lead to, at every instant. Figures are proven bounds (`planner.proof`)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from missions.environment.radars import exposed
from missions.errors import InputError
from missions.reference import Reference
from missions.scenario import Scenario
from planner import checks
from planner.formation_plan import FormationPlan, UavPlan
from planner.loiter import STACK_M, Circle, meeting
from planner.proof.flight import SpareSpeeds, spare_speeds
from planner.proof.separation import Separations, separations
from planner.proof.surroundings import Surroundings, surroundings
from planner.proof.tracks import Tracks

FloatArray = npt.NDArray[np.float64]

STEP_S = 0.5
"""Between the samples by which time within radars is counted: a figure, not a limit."""


@dataclass(frozen=True)
class UavReport:
    """What one UAV's path comes to. Heights and distances are the least, angles the largest along it.

    Attributes:
        clearance_m, wall_m, separation_m: above ground once airborne; from any obstacle, infinite where there is
            none; from any other UAV at the same time, infinite for a single one. Proven never to be less, and at most
            `planner.proof.bracket.RESOLUTION_M` below the truth.
        radar_exposure_s: time within any radar's radius.
    """

    sysid: int
    name: str
    arrival_s: float
    clearance_m: float
    wall_m: float
    separation_m: float
    turn_deg: float
    bank_deg: float
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
    by_sysid = plan.references(scenario)
    references = [by_sysid[uav.sysid] for uav in plan.uavs]
    tracks = Tracks(references)
    apart = separations(tracks, scenario.limits.separation_m)
    around = surroundings(tracks, references, scenario)
    spare = spare_speeds(tracks, scenario)
    violations = _too_near(plan, references, apart, scenario.limits.separation_m)
    violations += _loiters_meet(plan, references, scenario.limits.separation_m)
    uavs = []
    for row, (uav, reference) in enumerate(zip(plan.uavs, references, strict=True)):
        path = checks.flown(uav.mission, reference, row, scenario)
        report, faults = _uav(uav, path, tracks, apart, around, spare, scenario)
        faults += checks.ends(uav.mission, reference, vehicles[uav.sysid], scenario)
        uavs.append(report)
        violations += [Violation(uav.sysid, f"{uav.name}: {fault}") for fault in faults]
    order = {uav.sysid: i for i, uav in enumerate(plan.uavs)}
    return VerificationReport(tuple(uavs), tuple(sorted(violations, key=lambda violation: order[violation.sysid])))


def _uav(
    uav: UavPlan,
    path: checks.Flown,
    tracks: Tracks,
    apart: Separations,
    around: Surroundings,
    spare: SpareSpeeds,
    scenario: Scenario,
) -> tuple[UavReport, list[str]]:
    limits, reference = scenario.limits, path.reference
    clearance, faults = checks.clearance(path, around, scenario)
    wall, wall_faults = checks.walls(path, around, scenario)
    turn, turn_faults = checks.turns(path, limits.turn_max_deg)
    bank, bank_faults = checks.banks(path, tracks.fastest_m_s(path.row), scenario)
    climb, descent, climb_faults = checks.climbs(path, limits.climb_max_deg)
    shortest, longest, leg_faults = checks.legs(path, limits.leg_min_m, limits.leg_max_m)
    slowest, fastest, share, speed_faults = checks.speeds(path, scenario)
    highest, box_faults = checks.box(path, around, scenario)
    faults += wall_faults + turn_faults + bank_faults + climb_faults + leg_faults + speed_faults + box_faults
    faults += checks.instants(path, spare, scenario) + checks.fillets(path) + checks.loiter(path, around, scenario)
    positions = reference.positions(np.arange(0.0, reference.duration_s, STEP_S))
    report = UavReport(
        sysid=uav.sysid,
        name=uav.name,
        arrival_s=reference.duration_s,
        clearance_m=clearance,
        wall_m=wall,
        separation_m=float(apart.nearest_m[path.row]),
        turn_deg=turn,
        bank_deg=bank,
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


def _too_near(
    plan: FormationPlan, references: Sequence[Reference], apart: Separations, wanted_m: float
) -> list[Violation]:
    """The later UAV's violation of each pair that comes too near."""
    violations = []
    for k in np.flatnonzero(apart.of_pair.low < wanted_m - checks.TOLERANCE_M):
        first, second = (plan.uavs[row] for row in apart.pairs[k])
        t_s = float(apart.of_pair.at[k])
        where = checks.place(references[apart.pairs[k, 0]].positions(np.array(t_s)))
        text = (
            f"{second.name}: {apart.of_pair.value[k]:.0f} m from {first.name} after {t_s:.0f} s at {where}, "
            f"limits.separation_m is {wanted_m:g}"
        )
        violations.append(Violation(second.sysid, text))
    return violations


def _loiters_meet(plan: FormationPlan, references: Sequence[Reference], wanted_m: float) -> list[Violation]:
    """The later UAV's violation of each pair that loiters too near to each other."""
    circles = [
        Circle(*reference.target_m[:2], reference.loiter_z_m, abs(reference.loiter_radius_m))
        for reference in references
    ]
    return [
        Violation(
            plan.uavs[j].sysid,
            f"{plan.uavs[j].name}: loiters as high as {plan.uavs[i].name} beside it, less than {STACK_M:g} m apart",
        )
        for i, j in meeting(circles, wanted_m)
    ]
