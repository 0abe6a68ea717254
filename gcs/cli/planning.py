"""Planning with a progress bar on standard error, and plans made before."""

import logging
from dataclasses import dataclass
from pathlib import Path

from gcs.cli.progress import working
from gcs.run_folder import RunFolder
from missions.compiled import compiled_before
from missions.scenario import Scenario, parse_scenario, read_scenario_text, scenario_folder, shipped_scenarios
from planner.formation_plan import FormationPlan
from planner.plan import PlanProgress
from planner.plan import plan as search

_log = logging.getLogger(__name__)


def search_with_progress(scenario: Scenario, seed: int | None, method: str | None) -> FormationPlan:
    """Plan a scenario. Raises InputError as the planner does."""
    parts = [0.0] * len(scenario.vehicles)
    first = "" if compiled_before("cost") else ", after compiling: once, some 20 s"
    with working(f"Planning {scenario.name}{first}") as bar:

        def show(progress: PlanProgress) -> None:
            parts[progress.uav] = progress.part
            best = "no way yet" if progress.best_km is None else f"f = {progress.best_km:.2f} km"
            bar.show(sum(parts), len(parts), f"Planning {progress.name}", best)

        plan = search(scenario, seed=seed, method=method, progress=show)
    figures = (plan.scenario, plan.method, plan.seed, plan.compile_s, plan.plan_s)
    _log.info("%s planned by %s, seed %d: compiled in %.3f s, searched in %.3f s", *figures)
    return plan


@dataclass(frozen=True)
class Source:
    """What is to be flown: a scenario, its text, and its plan if there is one."""

    text: str
    scenario: Scenario
    plan: FormationPlan | None


def read_source(source: str) -> Source:
    """What a user has named: a scenario that ships, a scenario's file, or the folder of a planned run.

    Raises:
        InputError: there is no such thing, or it cannot be used.
    """
    if source not in shipped_scenarios() and Path(source).is_dir():
        run = RunFolder(Path(source))
        scenario, plan = run.read()
        text, _ = read_scenario_text(str(run.scenario))
        return Source(text, scenario, plan)
    text, label = read_scenario_text(source)
    return Source(text, parse_scenario(text, label, scenario_folder(source)), None)


def plan_for(run: RunFolder | None, source: Source, seed: int | None) -> FormationPlan:
    """The plan that there is, or one made now.

    Args:
        run: where it will be kept: removed again, if it is empty, when there is no plan.
        source: what to plan.
        seed: of the search; None for the scenario's.

    Raises:
        InputError: no plan was found.
    """
    if source.plan is not None:
        return source.plan
    try:
        return search_with_progress(source.scenario, seed, None)
    except BaseException:
        if run is not None:
            run.discard_if_empty()
        raise
