"""The 3D scene: all paths over the ground, among radars and obstacles."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.colors import LightSource, LinearSegmentedColormap
from matplotlib.ticker import MaxNLocator

from gcs.figures import style
from gcs.figures.paths import Ground, flown_paths, ground_below, planned_paths
from gcs.figures.style import KM
from gcs.theme import theme
from gcs.truth import Truths
from missions.environment import Environment
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

FloatArray = npt.NDArray[np.float64]

FRAME = (0.015, -0.11, 0.9, 1.17)
"""Of a view's axes, in shares of the page, or of its part of it: mplot3d leaves wide margins inside."""
VIEW_HEIGHT_IN = 6.0
PITCH_IN = 5.0
"""From one view to the next: their empty margins overlap."""
HEIGHT_SHARE = 0.3
"""How high the scene is drawn, about, as a share of its longer side."""
EXAGGERATIONS = (1, 2, 3, 5, 10, 15, 20, 30, 50)
TURNS = np.linspace(0.0, 2.0 * np.pi, 37)
"""Around a sphere or a cylinder."""


@dataclass(frozen=True)
class View:
    """From where a scene is seen, degrees: above the horizon, and round about, from +x anticlockwise."""

    above: float
    about: float


USUAL = View(above=32, about=-118)


def draw_scene(
    plan: FormationPlan,
    scenario: Scenario,
    truths: Truths | None,
    path: Path,
    *,
    views: Sequence[View] = (USUAL,),
    headline: str | None = None,
) -> None:
    """Draw what was flown, or without truths what is planned; once a view, one below the other."""
    references = plan.references(scenario)
    planned = planned_paths(references)
    paths = planned if truths is None else flown_paths(truths, references)
    environment = scenario.environment
    ground = ground_below(planned, environment)
    top_m = max(
        max(float(one[:, 2].max()) for one in planned.values()),
        float(ground.z_m.max()),
        *(radar.z_m + radar.radius_m for radar in environment.radars),
        *(obstacle.top_m for obstacle in environment.obstacles),
        environment.area.z_min_m + 1.0,
    )
    height_in = VIEW_HEIGHT_IN + PITCH_IN * (len(views) - 1)
    with style.page(path, height_in, layout=None) as figure:
        left, bottom, width, height = FRAME
        for row, view in enumerate(reversed(views)):
            share = VIEW_HEIGHT_IN / height_in
            frame = (left, row * PITCH_IN / height_in + bottom * share, width, height * share)
            axes: Any = figure.add_axes(frame, projection="3d", computed_zorder=False)
            axes.patch.set_visible(False)
            factor = _shape(axes, ground, float(ground.z_m.min()), top_m, view)
            _ground(axes, ground, factor)
            _radars(axes, environment, ground)
            _obstacles(axes, environment, ground)
            _paths(axes, paths, {sysid: one.target_m for sysid, one in references.items()}, scenario, ground)
        what = "planned" if truths is None else "flown"
        times = "to scale" if factor == 1 else f"exaggerated {factor}x"
        style.headline(figure, f"{headline or f'{scenario.name}: {len(paths)} {what} paths'}, heights {times}")
        style.legend_beside(figure, style.vehicle_handles(scenario) + style.surroundings_handles(environment))


def _paths(
    axes: Any,
    paths: Mapping[int, FloatArray],
    targets_m: Mapping[int, tuple[float, float, float]],
    scenario: Scenario,
    ground: Ground,
) -> None:
    """Each with its shadow on the lowest ground, a dot where it begins and a star at its target."""
    colours = style.vehicle_colours(scenario)
    for sysid, points in paths.items():
        x, y, z = points[:, 0] * KM, points[:, 1] * KM, points[:, 2]
        floor = np.full_like(z, ground.z_m.min())
        axes.plot(x, y, floor, color=colours[sysid], linewidth=0.8, alpha=0.25, zorder=2)
        axes.plot(x, y, z, color=colours[sysid], linewidth=1.8, zorder=5)
        axes.scatter(x[0], y[0], z[0], color=colours[sysid], s=12, marker="o", depthshade=False, zorder=6)
        target_x, target_y, target_z = targets_m[sysid]
        target = (target_x * KM, target_y * KM, target_z)
        axes.scatter(*target, color=colours[sysid], s=38, marker="*", depthshade=False, zorder=6)


def _shape(axes: Any, ground: Ground, bottom_m: float, top_m: float, view: View) -> int:
    """Set limits, labels and proportions; returns the factor by which heights are exaggerated."""
    x0, x1, y0, y1 = ground.extent_m
    longer, height = max(x1 - x0, y1 - y0), max(top_m - bottom_m, 1.0)
    factor = max(one for one in EXAGGERATIONS if one == 1 or one * height <= HEIGHT_SHARE * longer)
    axes.set_xlim(x0 * KM, x1 * KM)
    axes.set_ylim(y0 * KM, y1 * KM)
    axes.set_zlim(bottom_m, top_m)
    axes.set_box_aspect((x1 - x0, y1 - y0, factor * height), zoom=1.04)
    axes.view_init(elev=view.above, azim=view.about)
    axes.set_xlabel("east x (km)", labelpad=8)
    axes.set_ylabel("north y (km)", labelpad=8)
    axes.set_zlabel("altitude z (m)", labelpad=10)
    axes.zaxis.set_major_locator(MaxNLocator(4))
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.pane.set_visible(False)
    return factor


def _ground(axes: Any, ground: Ground, factor: int) -> None:
    """The shaded surface."""
    colours = LinearSegmentedColormap.from_list("ground", theme().ground)
    if ground.level:
        lit = np.broadcast_to(colours(0.0), (*ground.z_m.shape, 4))
    else:
        step_x, step_y = ground.x_m[1] - ground.x_m[0], ground.y_m[1] - ground.y_m[0]
        light = LightSource(azdeg=315, altdeg=40)
        lit = light.shade(
            ground.z_m, colours, blend_mode="soft", vert_exag=factor, dx=float(step_x), dy=float(step_y), fraction=0.8
        )
    x, y = np.meshgrid(ground.x_m * KM, ground.y_m * KM)
    axes.plot_surface(
        x, y, ground.z_m, facecolors=lit, rstride=1, cstride=1, linewidth=0.4, antialiased=True, shade=False,
        zorder=1, clip_on=False,
    )  # fmt: skip


def _radars(axes: Any, environment: Environment, ground: Ground) -> None:
    """Translucent spheres."""
    rise = np.linspace(0.0, np.pi, 19)
    for radar in environment.radars:
        x = radar.x_m + radar.radius_m * np.outer(np.cos(TURNS), np.sin(rise))
        y = radar.y_m + radar.radius_m * np.outer(np.sin(TURNS), np.sin(rise))
        z = radar.z_m + radar.radius_m * np.outer(np.ones_like(TURNS), np.cos(rise))
        # What of a sphere would lie under the ground is not drawn.
        z = np.maximum(z, ground.z_m.min())
        axes.plot_surface(x * KM, y * KM, z, color=style.RADAR, alpha=0.22, linewidth=0, zorder=4)


def _obstacles(axes: Any, environment: Environment, ground: Ground) -> None:
    """Cylinders from the lowest ground that is drawn."""
    for obstacle in environment.obstacles:
        x = (obstacle.x_m + obstacle.radius_m * np.cos(TURNS)) * KM
        y = (obstacle.y_m + obstacle.radius_m * np.sin(TURNS)) * KM
        heights = np.array([ground.z_m.min(), obstacle.top_m])
        wall = np.outer(heights, np.ones_like(TURNS))
        axes.plot_surface(np.tile(x, (2, 1)), np.tile(y, (2, 1)), wall, color=style.OBSTACLE, alpha=0.75, zorder=3)
        roof = np.full((2, len(TURNS)), heights[1])
        centre = np.array([[0.0], [1.0]])
        roof_x = obstacle.x_m * KM + centre * (x - obstacle.x_m * KM)
        roof_y = obstacle.y_m * KM + centre * (y - obstacle.y_m * KM)
        axes.plot_surface(roof_x, roof_y, roof, color=style.OBSTACLE, alpha=0.9, zorder=3)
