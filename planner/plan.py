"""A verified plan for all vehicles of a scenario."""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import count

import numpy as np
import numpy.typing as npt

from missions.errors import InputError
from missions.reference.reference import fillet_radius_m
from missions.scenario import Scenario
from planner.cost.constraints import with_progress
from planner.cost.kernel import INFEASIBLE_KM, evaluate, path_cost
from planner.cost.problem import NO_MARGINS, PathProblem, path_problem
from planner.find_path import EVALUATIONS, METHODS, NO_WISH, SKEIN, PathFound, find_path, vehicle_problem
from planner.find_route import FindPath, find_route
from planner.fit_slots import fit_slots
from planner.formation_plan import FitnessTerms, FormationPlan, UavPlan
from planner.infeasible import require_feasible, require_reachable
from planner.lengthen import too_short
from planner.limits import airspeed_range_m_s
from planner.loiter import Circle, stack
from planner.priority import search_alone, without_conflicts
from planner.schedule import Schedule, common_arrival, flyable_at
from planner.skein.search import skein_path
from planner.slots import route_of
from planner.verify import VerificationReport, require, verify
from planner.write_mission import write_mission

FloatArray = npt.NDArray[np.float64]

SLOTS = "slots"
"""The method of a scenario whose vehicles have slots on a route: there is nothing to search for."""
ROUTE_STREAM = 2
"""Purpose of the random streams of searches for a route, beside seed and attempt."""
LONGER = 8
"""Turns of planning that may ask UAVs for longer paths; then the schedule says what it can do with those there are."""
ATTEMPTS = 4
"""Plans of one UAV, each with its own chance and wider margins, before planning gives up."""


@dataclass(frozen=True)
class PlanProgress:
    """How far planning has come.

    Attributes:
        uav, uavs: which UAV, from 0, of how many; several are planned side by side.
        name: of that UAV.
        part: of its search that is done, 0 to 1.
        best_km: best feasible cost so far, or None.
    """

    uav: int
    uavs: int
    name: str
    part: float
    best_km: float | None


Progress = Callable[[PlanProgress], None]


def plan(
    scenario: Scenario, *, seed: int | None = None, method: str | None = None, progress: Progress | None = None
) -> FormationPlan:
    """Plan all vehicles: paths in order of priority, each avoiding the earlier ones in time; the schedule; the
    missions; and the verification that every plan passes before anyone sees it.

    Args:
        scenario: what to plan.
        seed: of all chance; the scenario's unless given.
        method: one of `planner.find_path.METHODS`; the scenario's unless given. Slots need none; their route,
            where it is searched, is so by `skein`.
        progress: told of every search, from several threads.

    Raises:
        InputError: no such method or seed, or no plan was found that keeps to all limits; says which UAV and why.
    """
    seed = scenario.seed if seed is None else seed
    method = SLOTS if scenario.route is not None else method or scenario.search.method
    if method not in (SLOTS, *METHODS):
        raise InputError(f"method {method}: must be one of {', '.join(METHODS)}")
    if seed < 0:
        raise InputError(f"seed {seed}: must be 0 or more")
    start = time.perf_counter()
    _compile(scenario, method)
    compiled = time.perf_counter()
    if method == SLOTS:
        result, report = _on_slots(scenario, seed, progress or (lambda _: None))
        require(report)
    else:
        result = _searched(scenario, seed, method, progress or (lambda _: None))
    return replace(result, compile_s=compiled - start, plan_s=time.perf_counter() - compiled)


def _compile(scenario: Scenario, method: str) -> None:
    """Have the kernels compiled, or loaded from their cache, by one use."""
    problem = path_problem(
        scenario, scenario.vehicles[0], np.empty((0, 2, 4)), scenario.airframe.airspeed_cruise_m_s, NO_MARGINS
    )
    path_cost(problem.corners_m([]), problem, False, np.empty(5))
    if method == SKEIN or (scenario.route is not None and scenario.route.is_searched):
        skein_path(problem, 1, budget=200, seed=0, report=lambda *_: None)
    elif method != SLOTS:
        evaluate(np.zeros((1, 3)), problem, "graded")
    with_progress(problem.corners_m([]), problem)
    one, airframe = np.ones(1), scenario.airframe.airframe()
    flyable_at(one, one, one, one, scenario.wind.forecast_m_s, airspeed_range_m_s(scenario), airframe)


def _searched(scenario: Scenario, seed: int, method: str, progress: Progress) -> FormationPlan:
    """Search for all paths; again, with other wishes, for those that the schedule or the verifier finds fault with."""
    vehicles = scenario.vehicles
    names = [vehicle.name for vehicle in vehicles]
    wishes = [NO_WISH] * len(vehicles)

    def search(i: int, avoided: Sequence[PathFound], threads: int | None = None) -> PathFound:
        def tell(done: int, of: int, best_km: float) -> None:
            feasible = best_km if best_km < INFEASIBLE_KM else None
            progress(PlanProgress(i, len(vehicles), names[i], done / of, feasible))

        path = find_path(
            scenario, vehicles[i], avoided, method=method, seed=seed, wish=wishes[i], threads=threads, report=tell
        )
        tell(1, 1, path.cost_km)
        return path

    for vehicle in vehicles:
        require_reachable(vehicle.name, vehicle_problem(scenario, vehicle), scenario.search.waypoints)
    alone = search_alone(len(vehicles), partial(search, threads=1), side_by_side=method == SKEIN)
    for turn in count():
        for name, path in zip(names, alone, strict=True):
            require_feasible(name, path)
        paths = without_conflicts(scenario, alone, search)
        corners = [path.corners_m for path in paths]
        again = too_short(corners, wishes, scenario) if turn < LONGER else {}
        if not again:
            result, report = _assembled(scenario, seed, method, paths, common_arrival(names, corners, scenario))
            if not report.violations:
                return result
            again = {
                i: replace(wishes[i], attempt=wishes[i].attempt + 1)
                for i, vehicle in enumerate(vehicles)
                if vehicle.sysid in report.at_fault
            }
            if any(wish.attempt == ATTEMPTS for wish in again.values()):
                require(report)
        for i, wish in again.items():
            wishes[i] = wish
            alone[i] = search(i, ())
    raise AssertionError("each turn is one of LONGER, or an attempt of some UAV")


def _on_slots(scenario: Scenario, seed: int, progress: Progress) -> tuple[FormationPlan, VerificationReport]:
    """Every slot's path and schedule, as wide as they fit the route; what they cost, without a search of their own."""
    assert scenario.route is not None
    if scenario.route.is_searched:
        slots = find_route(scenario, _route_finder(scenario, seed, progress))
    else:
        slots = fit_slots(scenario, route_of(scenario))
    paths = []
    for vehicle, corners in zip(scenario.vehicles, slots.paths_m, strict=True):
        problem = path_problem(
            scenario, vehicle, np.empty((0, len(corners), 4)), scenario.route.ground_speed_m_s, NO_MARGINS
        )
        paths.append(PathFound(problem, corners, 0.0, 0, ()))
    result, report = _assembled(scenario, seed, SLOTS, paths, slots.schedules)
    scale, stagger = tuple(slots.fit.scale.tolist()), tuple(slots.fit.stagger.tolist())
    return replace(result, slot_scale=scale, slot_stagger=stagger), report


def _route_finder(scenario: Scenario, seed: int, progress: Progress) -> FindPath:
    """Searches for routes, each with its own chance."""
    settings, attempts = scenario.search, count()
    budget = settings.population * settings.iterations * EVALUATIONS

    def find(problem: PathProblem, waypoints: int) -> FloatArray | None:
        def tell(evaluations: int, best_km: float) -> None:
            feasible = best_km if best_km < INFEASIBLE_KM else None
            progress(PlanProgress(0, 1, "route", evaluations / budget, feasible))

        chance = np.random.SeedSequence([seed, ROUTE_STREAM, next(attempts)])
        found = skein_path(problem, waypoints, budget=budget, seed=int(chance.generate_state(1)[0]), report=tell)
        return problem.corners_m(found.x) if found.fun < INFEASIBLE_KM else None

    return find


def _assembled(
    scenario: Scenario, seed: int, method: str, paths: Sequence[PathFound], schedules: Sequence[Schedule]
) -> tuple[FormationPlan, VerificationReport]:
    """Loiters, missions and figures of paths with their schedules, and what the verifier says of them."""
    vehicles, limits = scenario.vehicles, scenario.limits
    targets = [scenario.target_m(vehicle) for vehicle in vehicles]
    circles = stack(
        [vehicle.name for vehicle in vehicles],
        [
            Circle(x, y, z, math.ceil(fillet_radius_m(float(schedule.ground_m_s.max()))))
            for (x, y, z), schedule in zip(targets, schedules, strict=True)
        ],
        limits.separation_m,
        min(limits.altitude_max_m, scenario.environment.area.z_max_m),
    )
    uavs = []
    for vehicle, path, schedule, circle in zip(vehicles, paths, schedules, circles, strict=True):
        uavs.append(
            UavPlan(
                sysid=vehicle.sysid,
                name=vehicle.name,
                waypoints_m=path.corners_m,
                terms=_terms(path.corners_m, path.problem),
                straight_line_m=float(np.linalg.norm(path.corners_m[-1] - path.corners_m[0])),
                length_m=float(np.sum(np.hypot(schedule.arcs_m, schedule.arcs_m * schedule.slopes))),
                evaluations=path.evaluations,
                history=tuple((n, cost if cost < INFEASIBLE_KM else None) for n, cost in path.history),
                mission=write_mission(path.corners_m, schedule, circle, scenario.frame),
            )
        )
    result = FormationPlan(scenario.name, seed, method, tuple(uavs), compile_s=0.0, plan_s=0.0)
    return result, verify(result, scenario)


def _terms(corners_m: FloatArray, problem: PathProblem) -> FitnessTerms:
    """The objective's terms of a path that keeps to all limits: the same in both readings."""
    terms = np.empty(5)
    path_cost(corners_m, problem, False, terms)
    return FitnessTerms(*terms.tolist())
