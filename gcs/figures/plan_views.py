"""The flight from above and from the side: planned and flown."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patches import Circle, Ellipse, Rectangle

from gcs.figures import style
from gcs.figures.paths import Ground, flown_paths, ground_below, planned_paths
from gcs.figures.style import KM
from gcs.truth import Truths
from missions.environment import Environment
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

FloatArray = npt.NDArray[np.float64]

MAP_WIDTH_IN = 7.4
SIDE_HEIGHT_IN = 2.3
REST_IN = 2.0
"""Of the page's height: titles and labels."""


def draw_plan_views(plan: FormationPlan, scenario: Scenario, truths: Truths | None, path: Path) -> None:
    """Draw the map (x, y) and the side view (x, z); without truths what is planned only."""
    references = plan.references(scenario)
    planned = planned_paths(references)
    flown = {} if truths is None else flown_paths(truths, references)
    ground = ground_below(planned, scenario.environment)
    x0, x1, y0, y1 = ground.extent_m
    map_height_in = MAP_WIDTH_IN * (y1 - y0) / (x1 - x0)
    with style.page(path, map_height_in + SIDE_HEIGHT_IN + REST_IN, "compressed") as figure:
        above, side = figure.subplots(2, 1, sharex=True, height_ratios=[map_height_in, SIDE_HEIGHT_IN])
        _map(above, ground, scenario.environment)
        _side(side, ground, scenario.environment)
        colours = style.vehicle_colours(scenario)
        for axes, column, unit in ((above, 1, KM), (side, 2, 1.0)):
            for sysid, points in flown.items():
                axes.plot(points[:, 0] * KM, points[:, column] * unit, color=colours[sysid], linewidth=2.6)
            _planned(axes, planned, column, unit, colours if truths is None else None)
        above.set_title("From above")
        above.set_aspect("equal")
        above.set_xlim(x0 * KM, x1 * KM)
        above.set_ylim(y0 * KM, y1 * KM)
        above.set_ylabel("north y (km)")
        side.set_title(
            "From the south, not to scale" + ("" if ground.level else "; behind, the highest ground along y")
        )
        side.set_xlabel("east x (km)")
        side.set_ylabel("altitude z (m)")
        style.headline(figure, f"{scenario.name}: {'planned' if truths is None else 'planned and flown'}")
        handles = [*style.vehicle_handles(scenario), *style.surroundings_handles(scenario.environment)]
        if flown:
            handles.append(style.line_handle("planned", color=style.INK, linewidth=0.9, linestyle=style.DASHES))
        style.legend_beside(figure, handles)


def _planned(
    axes: Axes, planned: Mapping[int, FloatArray], column: int, unit: float, colours: Mapping[int, Any] | None
) -> None:
    """Thin dark dashes over what was flown; in the vehicles' colours where nothing was."""
    for sysid, points in planned.items():
        x, other = points[:, 0] * KM, points[:, column] * unit
        if colours is None:
            axes.plot(x, other, color=style.INK, linewidth=0.8, linestyle=style.DASHES)
        else:
            axes.plot(x, other, color=colours[sysid], linestyle=style.DASHES)
        axes.plot(x[-1], other[-1], marker="*", markersize=9, color=style.INK, linestyle="")


def _map(axes: Axes, ground: Ground, environment: Environment) -> None:
    axes.grid(visible=False)
    colours = LinearSegmentedColormap.from_list("ground", style.GROUND)
    axes.set_facecolor(style.GROUND[0])
    if not ground.level:
        x, y = ground.x_m * KM, ground.y_m * KM
        filled = axes.contourf(x, y, ground.z_m, levels=12, cmap=colours)
        axes.contour(x, y, ground.z_m, levels=filled.levels, colors=style.FAINT, linewidths=0.4)
        axes.figure.colorbar(filled, ax=axes, label="ground z (m)", shrink=0.8, pad=0.01)
    for radar in environment.radars:
        centre = (radar.x_m * KM, radar.y_m * KM)
        axes.add_patch(Circle(centre, radar.radius_m * KM, color=style.RADAR, alpha=0.35, linewidth=0))
    for obstacle in environment.obstacles:
        axes.add_patch(Circle((obstacle.x_m * KM, obstacle.y_m * KM), obstacle.radius_m * KM, color=style.OBSTACLE))


def _side(axes: Axes, ground: Ground, environment: Environment) -> None:
    """The highest ground along y stands as a silhouette behind all else."""
    lowest = float(ground.z_m.min())
    silhouette = ground.z_m.max(axis=0)
    axes.fill_between(ground.x_m * KM, silhouette, lowest, color=style.GROUND[1], linewidth=0)
    for radar in environment.radars:
        size = (2.0 * radar.radius_m * KM, 2.0 * radar.radius_m)
        axes.add_patch(Ellipse((radar.x_m * KM, radar.z_m), *size, color=style.RADAR, alpha=0.25, linewidth=0))
    for obstacle in environment.obstacles:
        corner = ((obstacle.x_m - obstacle.radius_m) * KM, lowest)
        size = (2.0 * obstacle.radius_m * KM, obstacle.top_m - lowest)
        axes.add_patch(Rectangle(corner, *size, color=style.OBSTACLE, alpha=0.7, linewidth=0))
