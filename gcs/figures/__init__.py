"""Pictures of plans and flights."""

from pathlib import Path

from gcs.figures.arms import draw_arms
from gcs.figures.convergence import draw_convergence
from gcs.figures.formation import draw_formation
from gcs.figures.heights import draw_heights
from gcs.figures.mission_files import draw_mission_files
from gcs.figures.plan_views import draw_plan_views
from gcs.figures.scene import draw_scene
from gcs.figures.schedule import draw_schedule
from gcs.metrics.series import Series
from gcs.truth import Truths
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

__all__ = [
    "draw_all",
    "draw_arms",
    "draw_convergence",
    "draw_formation",
    "draw_heights",
    "draw_mission_files",
    "draw_plan",
    "draw_plan_views",
    "draw_scene",
    "draw_schedule",
]


def draw_plan(scenario: Scenario, plan: FormationPlan, folder: Path) -> None:
    """Draw what is planned, before anybody flies it, into an existing folder. Raises OSError."""
    draw_scene(plan, scenario, None, folder / "scene.png")
    draw_plan_views(plan, scenario, None, folder / "plan_views.png")
    draw_heights(plan, scenario, folder / "heights.png")


def draw_all(scenario: Scenario, plan: FormationPlan, truths: Truths, series: Series, folder: Path) -> list[Path]:
    """Draw every picture that there is of one flight into an existing folder; returns the files. Raises OSError."""
    scene, views, schedule = folder / "scene.png", folder / "plan_views.png", folder / "schedule.png"
    draw_scene(plan, scenario, truths, scene)
    draw_plan_views(plan, scenario, truths, views)
    draw_schedule(scenario, series, schedule)
    files = [scene, views, schedule]
    if len(plan.uavs) > 1:
        files.append(folder / "formation.png")
        draw_formation(scenario, series, files[-1])
    if any(uav.history for uav in plan.uavs):
        files.append(folder / "convergence.png")
        draw_convergence(plan, scenario, files[-1])
    return files
