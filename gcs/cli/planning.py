"""Planning with a progress bar on standard error, and plans made before."""

from pathlib import Path

from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from gcs.cli import output
from gcs.run_folder import RunFolder
from missions.scenario import Scenario, parse_scenario, read_scenario_text, scenario_folder, shipped_scenarios
from planner.formation_plan import FormationPlan
from planner.plan import PlanProgress
from planner.plan import plan as search


def search_with_progress(scenario: Scenario, seed: int | None, method: str | None) -> FormationPlan:
    """Plan a scenario. Raises InputError as the planner does."""
    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn(), TextColumn("{task.fields[best]}"))
    with Progress(*columns, console=output.progress, transient=True) as bar:
        task = bar.add_task(f"Planning {scenario.name}", total=len(scenario.vehicles), best="compiling")

        parts = [0.0] * len(scenario.vehicles)

        def show(progress: PlanProgress) -> None:
            parts[progress.uav] = progress.part
            best = "no way yet" if progress.best_km is None else f"f = {progress.best_km:.2f} km"
            bar.update(task, completed=sum(parts), description=f"Planning {progress.name}", best=best)

        return search(scenario, seed=seed, method=method, progress=show)


def plan_of(source: str, seed: int | None) -> tuple[str, Scenario, FormationPlan]:
    """The text of a scenario, the scenario, and its plan: that of a planned run, or one made now.

    Args:
        source: name of a scenario that ships, a scenario's file, or a run's folder.
        seed: of the search, when there is one; None for the scenario's.

    Raises:
        InputError: there is no such thing, it cannot be used, or no plan was found.
    """
    if source not in shipped_scenarios() and Path(source).is_dir():
        run = RunFolder(Path(source))
        scenario, plan = run.read()
        text, _ = read_scenario_text(str(run.scenario))
        return text, scenario, plan
    text, label = read_scenario_text(source)
    scenario = parse_scenario(text, label, scenario_folder(source))
    return text, scenario, search_with_progress(scenario, seed, None)
