"""The problems that searches are compared on, by name: generated ones and those of the paper's scenarios.

A generated problem is `family-waypoints-number`, such as `walls-20-3`. Numbers 1 to 5 are levels from easy to brutal,
6 to 10 are other draws of the same levels, and so on without end. A scenario's is `scenario-vehicle`, such as
`radars-F3`: that vehicle alone.
"""

import difflib
import re
import zlib
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from missions.errors import InputError
from missions.scenario import load_scenario
from planner.bench.digest import problem_digest
from planner.bench.draft import problem_of
from planner.bench.families import FAMILIES
from planner.cost.kernel import INFEASIBLE_KM, evaluate
from planner.cost.problem import PathProblem
from planner.find_path import vehicle_problem

FloatArray = npt.NDArray[np.float64]

LEVELS = 5
SIZES = ((5, 1), (10, 2), (12, 3), (20, 4), (20, 5), (40, 5))
"""Waypoints and numbers of each family's problems in the suite."""
WAYPOINTS = 4, 60
"""Fewest and most that a generated problem may have."""
SCENARIOS = ("radars", "mountains")
PAPER = "paper"
"""The family of the scenarios' problems."""
QUICK = ("cylinders-5-1", "walls-10-2", "canyons-12-3", "forest-10-2", "radars-leader", "mountains-leader")
DRAWS = 200


@dataclass(frozen=True)
class BenchProblem:
    """A problem with all that a comparison needs to know of it.

    Attributes:
        name, family: for tables.
        problem: what a path must mind; no other UAVs.
        waypoints: interior ones.
        digest: of all this.
        route_m: (waypoints + 2, 3) a feasible path known by construction; None for a scenario's problem.
    """

    name: str
    family: str
    problem: PathProblem
    waypoints: int
    digest: str
    route_m: FloatArray | None

    @property
    def dimension(self) -> int:
        """Numbers that a search must find."""
        return 3 * self.waypoints


def suite() -> tuple[str, ...]:
    """Names of the official problems."""
    generated = [f"{family}-{waypoints}-{number}" for family in FAMILIES for waypoints, number in SIZES]
    alone = [f"{name}-{vehicle.name}" for name in SCENARIOS for vehicle in load_scenario(name).vehicles]
    return (*generated, *alone)


def problem_names(chosen: str) -> tuple[str, ...]:
    """Names from a list with commas of names, families, `paper`, `quick` or `all`. Raises InputError."""
    names: dict[str, None] = {}
    for word in filter(None, chosen.split(",")):
        if word == "all":
            found = suite()
        elif word == "quick":
            found = QUICK
        elif word == PAPER:
            found = tuple(name for name in suite() if name.partition("-")[0] in SCENARIOS)
        elif word in FAMILIES:
            found = tuple(name for name in suite() if name.partition("-")[0] == word)
        else:
            found = (bench_problem(word).name,)
        names |= dict.fromkeys(found)
    if not names:
        raise InputError("--problems: names no problem")
    return tuple(names)


@lru_cache(maxsize=64)
def bench_problem(name: str) -> BenchProblem:
    """The problem of a name.

    Raises:
        InputError: there is none; the message names the nearest that there is.
    """
    scenario_name, _, vehicle_name = name.partition("-")
    if scenario_name in SCENARIOS:
        scenario = load_scenario(scenario_name)
        for vehicle in scenario.vehicles:
            if vehicle.name == vehicle_name:
                waypoints = scenario.search.waypoints
                problem = vehicle_problem(scenario, vehicle)
                return BenchProblem(name, PAPER, problem, waypoints, problem_digest(problem, waypoints), None)
    match = re.fullmatch(r"([a-z]+)-([1-9]\d*)-([1-9]\d*)", name)
    if match and match[1] in FAMILIES:
        waypoints, number = int(match[2]), int(match[3])
        if not WAYPOINTS[0] <= waypoints <= WAYPOINTS[1]:
            raise InputError(f"problem {name}: {WAYPOINTS[0]} to {WAYPOINTS[1]} waypoints, got {waypoints}")
        return _generated(name, match[1], waypoints, number)
    near = difflib.get_close_matches(name, (*suite(), *FAMILIES, PAPER, "quick", "all"), n=1)
    raise InputError(
        f"problem {name}: there is none{f'; did you mean {near[0]}?' if near else ''} "
        f"(families {', '.join(FAMILIES)}, as in walls-20-3; scenarios {', '.join(SCENARIOS)}, as in radars-F3)"
    )


def _generated(name: str, family: str, waypoints: int, number: int) -> BenchProblem:
    """Draw until the hidden route keeps to all limits, which the kernel judges."""
    for draw in range(DRAWS):
        seeds = np.random.SeedSequence([zlib.crc32(family.encode()), waypoints, number, draw])
        draft = FAMILIES[family](np.random.default_rng(seeds), waypoints, (number - 1) % LEVELS)
        problem, route = problem_of(draft)
        costs, _ = evaluate(route[1:-1].reshape(1, -1), problem, "graded")
        if costs[0] < INFEASIBLE_KM:
            return BenchProblem(name, family, problem, waypoints, problem_digest(problem, waypoints), route)
    raise InputError(f"problem {name}: no draw of {DRAWS} has a way; choose more waypoints or another number")
