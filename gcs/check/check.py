"""Mission files checked: what endpoints do not fly, where a flight breaks a limit, and where two of them meet."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gcs.check.flight import Flight, planned_flight
from gcs.check.held import VehicleLimits, forbidden
from gcs.check.judge import Judge
from gcs.check.problem import Problem
from missions.errors import InputError
from missions.fence import fence_items
from missions.formats.mission_file import MissionFile
from missions.plan_type import PlanType
from missions.scenario import Scenario
from planner.checks import TOLERANCE_M
from planner.proof.separation import separations
from planner.proof.tracks import Tracks
from sitl.services.item_rules import refusal

_ITEM = re.compile(r"mission item (\d+): ")


@dataclass(frozen=True)
class Figures:
    """What a flight comes to.

    Attributes:
        file: that it is of.
        length_m, duration_s: until the mission has been flown.
        items: in the mission, home included.
    """

    file: Path
    items: int
    length_m: float
    duration_s: float


@dataclass(frozen=True)
class Checked:
    """What came of a check: figures of every flight that there is, and all problems, in the order of the files."""

    figures: tuple[Figures, ...]
    problems: tuple[Problem, ...]


def check_files(
    files: Sequence[MissionFile],
    scenario: Scenario,
    *,
    ground_known: bool,
    limits_given: bool,
    endurance_s: float = math.inf,
    range_m: float = math.inf,
    vehicle: VehicleLimits | None = None,
) -> Checked:
    """Check missions, each alone and all flown at once from the same moment on.

    Args:
        files: that were read.
        scenario: with the limits, the airframe and the ground.
        ground_known, limits_given, endurance_s, range_m: as of `Judge`.
        vehicle: that is to fly them, which forbids some; None without one.
    """
    figures, problems = [], []
    flights: list[tuple[MissionFile, Flight]] = []
    for one in files:
        flight = None
        if named := not_flown(one):
            problems += named
        else:
            try:
                flight = planned_flight(one.plan, scenario)
            except InputError as error:
                problems.append(_as_problem(one.path, str(error)))
        if vehicle is not None:
            problems += forbidden(one.path, one.plan, flight, vehicle, scenario)
        if flight is None:
            continue
        flights.append((one, flight))
        figures.append(Figures(one.path, len(one.plan.mission), flight.ended_m, flight.ended_s))
        judge = Judge(one.path, flight, one.plan.fence, scenario, ground_known, limits_given, endurance_s, range_m)
        problems += judge.problems()
    problems += _too_near(flights, scenario)
    order = {str(one.path): index for index, one in enumerate(files)}
    return Checked(tuple(figures), tuple(sorted(problems, key=lambda problem: order[problem.file])))


def _as_problem(path: Path, error: str) -> Problem:
    """An error about a mission, its item where it names one."""
    found = _ITEM.match(error)
    if found is None:
        return Problem(str(path), None, error)
    return Problem(str(path), int(found[1]), f"not flown here: {error[found.end() :]}")


def not_flown(one: MissionFile) -> list[Problem]:
    """The items of a file that Skein's endpoints refuse."""
    plan = one.plan
    parts = (
        (PlanType.MISSION, plan.mission.items, 1),
        (PlanType.FENCE, fence_items(plan.fence), 0),
        (PlanType.RALLY, plan.rally, 0),
    )
    found = []
    for kind, items, first in parts:
        for seq, item in enumerate(items[first:], start=first):
            if (refused := refusal(item, kind, len(items))) is not None:
                where = "" if kind == PlanType.MISSION else f"{kind.name.lower()} item {seq}: "
                number = seq if kind == PlanType.MISSION else None
                found.append(Problem(str(one.path), number, f"not flown here: {where}{refused.reason}"))
    return found


def _too_near(flights: Sequence[tuple[MissionFile, Flight]], scenario: Scenario) -> list[Problem]:
    """The later file's problem of each pair that comes too near, until the first of the two has arrived."""
    if len(flights) < 2:
        return []
    wanted_m = scenario.limits.separation_m
    apart = separations(Tracks([flight.whole for _, flight in flights]), wanted_m)
    found = []
    for k in np.flatnonzero(apart.of_pair.low < wanted_m - TOLERANCE_M):
        (first, _), (second, flight) = (flights[row] for row in apart.pairs[k])
        t_s = float(apart.of_pair.at[k])
        x, y, _ = flight.whole.positions(np.array(t_s)).tolist()
        lat_deg, lon_deg = scenario.frame.to_geodetic(x, y)
        found.append(
            Problem(
                str(second.path),
                flight.item_at(float(flight.whole.arc_lengths(np.array(t_s)))),
                f"distance from {first.path.name} after {t_s:.0f} s",
                f"{apart.of_pair.value[k]:.0f} m",
                f"{wanted_m:g} m",
                round(lat_deg, 7),
                round(lon_deg, 7),
            )
        )
    return found
