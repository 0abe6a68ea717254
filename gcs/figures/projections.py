"""Planned and flown paths projected on a plane: from above, from the south, from the east."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.patches import Circle, Ellipse, Rectangle

from gcs.figures import style
from gcs.figures.paths import Ground, flown_paths, ground_below, planned_paths
from gcs.figures.style import KM
from gcs.theme import theme
from gcs.truth import Truths
from missions.environment import Environment
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

FloatArray = npt.NDArray[np.float64]

Plane = Literal["xy", "xz", "yz"]
TITLES: Mapping[Plane, str] = {
    "xy": "From above",
    "xz": "From the south, not to scale",
    "yz": "From the east, not to scale",
}
AXES = ("east x (km)", "north y (km)", "altitude z (m)")
MAP_WIDTH_IN = 7.4
SIDE_HEIGHT_IN = 3.4
REST_IN = 1.4
"""Of the page's height: titles and labels."""


def draw_projection(
    plan: FormationPlan, scenario: Scenario, truths: Truths | None, plane: Plane, headline: str, path: Path
) -> None:
    """Draw one projection on a page of its own; without truths what is planned only."""
    references = plan.references(scenario)
    planned = planned_paths(references)
    flown = {} if truths is None else flown_paths(truths, references)
    ground = ground_below(planned, scenario.environment)
    x0, x1, y0, y1 = ground.extent_m
    height_in = MAP_WIDTH_IN * (y1 - y0) / (x1 - x0) if plane == "xy" else SIDE_HEIGHT_IN
    with style.page(path, height_in + REST_IN, "compressed" if plane == "xy" else "constrained") as figure:
        axes = figure.subplots()
        project(axes, plane, ground, scenario, planned, flown)
        axes.set_title(title_of(plane, ground))
        axes.set_xlabel(AXES["xyz".index(plane[0])])
        style.headline(figure, headline)
        handles = [*style.vehicle_handles(scenario), *style.surroundings_handles(scenario.environment)]
        if flown:
            handles.append(style.line_handle("planned", color=theme().ink, linewidth=0.9, linestyle=style.DASHES))
        style.legend_beside(figure, handles)


def title_of(plane: Plane, ground: Ground) -> str:
    """What a projection shows."""
    hidden = (
        "" if plane == "xy" or ground.level else f"; behind, the highest ground along {'y' if plane == 'xz' else 'x'}"
    )
    return TITLES[plane] + hidden


def project(
    axes: Axes,
    plane: Plane,
    ground: Ground,
    scenario: Scenario,
    planned: Mapping[int, FloatArray],
    flown: Mapping[int, FloatArray],
) -> None:
    """Draw surroundings and paths: what was flown in the vehicles' colours, under thin dashes for what was planned;
    where nothing was flown, the dashes have the colours."""
    across, up = "xyz".index(plane[0]), "xyz".index(plane[1])
    unit = KM if plane == "xy" else 1.0
    x0, x1, y0, y1 = ground.extent_m
    if plane == "xy":
        _map(axes, ground, scenario.environment)
        axes.set_aspect("equal")
        axes.set_ylim(y0 * KM, y1 * KM)
    else:
        _side(axes, ground, scenario.environment, across)
    axes.set_xlim(*((x0 * KM, x1 * KM) if across == 0 else (y0 * KM, y1 * KM)))
    axes.set_ylabel(AXES[up])
    colours = style.vehicle_colours(scenario)
    for sysid, points in flown.items():
        axes.plot(points[:, across] * KM, points[:, up] * unit, color=colours[sysid], linewidth=2.6)
    for sysid, points in planned.items():
        look: dict[str, Any] = {"color": theme().ink, "linewidth": 0.8} if flown else {"color": colours[sysid]}
        axes.plot(points[:, across] * KM, points[:, up] * unit, linestyle=style.DASHES, **look)
        end = points[-1]
        axes.plot(end[across] * KM, end[up] * unit, marker="*", markersize=9, color=theme().ink, linestyle="")


def draw_ground(axes: Axes, ground: Ground) -> None:
    """The ground from above, by its heights."""
    axes.grid(visible=False)
    colours = LinearSegmentedColormap.from_list("ground", theme().ground)
    axes.set_facecolor(theme().ground[0])
    if not ground.level:
        x, y = ground.x_m * KM, ground.y_m * KM
        filled = axes.contourf(x, y, ground.z_m, levels=12, cmap=colours)
        axes.contour(x, y, ground.z_m, levels=filled.levels, colors=theme().faint, linewidths=0.4)
        axes.figure.colorbar(filled, ax=axes, label="ground z (m)", shrink=0.8, pad=0.01)


def _map(axes: Axes, ground: Ground, environment: Environment) -> None:
    draw_ground(axes, ground)
    for radar in environment.radars:
        centre = (radar.x_m * KM, radar.y_m * KM)
        axes.add_patch(Circle(centre, radar.radius_m * KM, color=style.RADAR, alpha=0.35, linewidth=0))
    for obstacle in environment.obstacles:
        axes.add_patch(Circle((obstacle.x_m * KM, obstacle.y_m * KM), obstacle.radius_m * KM, color=style.OBSTACLE))


def _side(axes: Axes, ground: Ground, environment: Environment, across: int) -> None:
    """The highest ground along the line of sight stands as a silhouette behind all else.

    Args:
        across: 0 for x to the right, 1 for y.
    """
    lowest = float(ground.z_m.min())
    silhouette = ground.z_m.max(axis=across)
    along = (ground.x_m, ground.y_m)[across]
    axes.fill_between(along * KM, silhouette, lowest, color=theme().ground[1], linewidth=0)
    for radar in environment.radars:
        size = (2.0 * radar.radius_m * KM, 2.0 * radar.radius_m)
        centre = ((radar.x_m, radar.y_m)[across] * KM, radar.z_m)
        axes.add_patch(Ellipse(centre, *size, color=style.RADAR, alpha=0.25, linewidth=0))
    for obstacle in environment.obstacles:
        corner = (((obstacle.x_m, obstacle.y_m)[across] - obstacle.radius_m) * KM, lowest)
        size = (2.0 * obstacle.radius_m * KM, obstacle.top_m - lowest)
        axes.add_patch(Rectangle(corner, *size, color=style.OBSTACLE, alpha=0.7, linewidth=0))
