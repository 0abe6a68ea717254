"""The flight from above and from the side: planned and flown."""

from pathlib import Path

from gcs.figures import style
from gcs.figures.paths import flown_paths, ground_below, planned_paths
from gcs.figures.projections import AXES, MAP_WIDTH_IN, Plane, project, title_of
from gcs.theme import theme
from gcs.truth import Truths
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

SIDE_HEIGHT_IN = 2.3
REST_IN = 2.0
"""Of the page's height: titles and labels."""
PLANES: tuple[Plane, Plane] = ("xy", "xz")


def draw_plan_views(plan: FormationPlan, scenario: Scenario, truths: Truths | None, path: Path) -> None:
    """Draw the map (x, y) and the side view (x, z); without truths what is planned only."""
    references = plan.references(scenario)
    planned = planned_paths(references)
    flown = {} if truths is None else flown_paths(truths, references)
    ground = ground_below(planned, scenario.environment)
    x0, x1, y0, y1 = ground.extent_m
    map_height_in = MAP_WIDTH_IN * (y1 - y0) / (x1 - x0)
    with style.page(path, map_height_in + SIDE_HEIGHT_IN + REST_IN, "compressed") as figure:
        both = figure.subplots(2, 1, sharex=True, height_ratios=[map_height_in, SIDE_HEIGHT_IN])
        for axes, plane in zip(both, PLANES, strict=True):
            project(axes, plane, ground, scenario, planned, flown)
            axes.set_title(title_of(plane, ground))
        both[1].set_xlabel(AXES[0])
        style.headline(figure, f"{scenario.name}: {'planned' if truths is None else 'planned and flown'}")
        handles = [*style.vehicle_handles(scenario), *style.surroundings_handles(scenario.environment)]
        if flown:
            handles.append(style.line_handle("planned", color=theme().ink, linewidth=0.9, linestyle=style.DASHES))
        style.legend_beside(figure, handles)
