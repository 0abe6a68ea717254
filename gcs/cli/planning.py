"""Planning with a progress bar on standard error."""

from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from gcs.cli import output
from missions.scenario import Scenario
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
