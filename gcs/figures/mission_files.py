"""Mission files as they would be flown: a map of items, acceptance radii, circles, fences and rally points."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Polygon

from gcs.figures import style
from gcs.figures.paths import ground_below
from gcs.figures.projections import AXES, draw_ground
from gcs.figures.style import KM
from gcs.theme import theme
from missions.commands import PLACES, Command
from missions.fence import Fence, FenceCircle
from missions.frame import LocalFrame
from missions.mission import Mission
from missions.reference.reference import place_m, position_m
from missions.scenario import Scenario
from missions.vehicle_plan import Plan

FloatArray = npt.NDArray[np.float64]

MAP_WIDTH_IN = 6.6
REST_IN = 1.1
"""Of the page's height: titles and labels."""
CIRCLES = frozenset({Command.NAV_LOITER_UNLIM, Command.NAV_LOITER_TURNS, Command.NAV_LOITER_TO_ALT})
"""Items whose param3 is a radius."""


def draw_mission_files(plans: Mapping[str, Plan], scenario: Scenario, path: Path) -> None:
    """Draw plans by name on one map. Raises OSError.

    Args:
        plans: as read from files; altitudes in any frame.
        scenario: with the local frame and the ground below.
        path: of the PNG file.
    """
    ways = {name: _places(plan.mission, scenario.frame) for name, plan in plans.items()}
    rims = [_rim(plan.fence, scenario.frame) for plan in plans.values()]
    ground = ground_below(dict(enumerate([*ways.values(), *rims])), scenario.environment)
    x0, x1, y0, y1 = ground.extent_m
    colours = style.colours(len(plans))
    with style.page(path, MAP_WIDTH_IN * (y1 - y0) / (x1 - x0) + REST_IN, "compressed") as figure:
        axes = figure.subplots()
        draw_ground(axes, ground)
        for (name, plan), colour in zip(plans.items(), colours, strict=True):
            axes.plot(*(ways[name][:, :2] * KM).T, color=colour, linewidth=1.4)
            _items(axes, plan.mission, scenario.frame, colour)
            _fence(axes, plan.fence, scenario.frame)
            for rally in plan.rally:
                x, y = scenario.frame.from_e7(rally.lat_e7, rally.lon_e7)
                axes.plot(x * KM, y * KM, marker="^", **_rally())
        axes.set_aspect("equal")
        axes.set_xlim(x0 * KM, x1 * KM)
        axes.set_ylim(y0 * KM, y1 * KM)
        axes.set_xlabel(AXES[0])
        axes.set_ylabel(AXES[1])
        style.headline(
            figure, f"What {len(plans)} mission files hold" if len(plans) > 1 else "What a mission file holds"
        )
        style.legend_beside(figure, _handles(list(plans), colours))


def _places(mission: Mission, frame: LocalFrame) -> FloatArray:
    """(n, 3) home and the items that have a place, metres."""
    home = mission.home
    places = [position_m(home, home, frame)]
    for seq, item in enumerate(mission.items[1:], start=1):
        if item.command in PLACES:
            places.append(place_m(seq, item, home, frame, places[-1]))
    return np.array(places)


def _items(axes: Axes, mission: Mission, frame: LocalFrame, colour: str) -> None:
    """A dot a place; around a waypoint what counts as reached, and the circles that are flown."""
    home = position_m(mission.home, mission.home, frame)
    before = home
    for seq, item in enumerate(mission.items[1:], start=1):
        if item.command not in PLACES:
            continue
        before = place_m(seq, item, mission.home, frame, before)
        x, y = before[0] * KM, before[1] * KM
        axes.plot(x, y, marker="o", markersize=3, color=colour, linestyle="")
        radius_m = item.param2 if item.command == Command.NAV_WAYPOINT else 0.0
        radius_m = abs(item.param3) if item.command in CIRCLES else radius_m
        if radius_m > 0.0:
            axes.add_patch(Circle((x, y), radius_m * KM, facecolor="none", edgecolor=colour, linewidth=0.8))
    axes.plot(home[0] * KM, home[1] * KM, marker="s", **_home(), color=colour)


def _fence(axes: Axes, fence: Fence, frame: LocalFrame) -> None:
    """Areas to stay in are drawn as a line, those to stay out of are filled."""
    for area in fence.areas:
        look: dict[str, Any] = (
            {"facecolor": "none", "edgecolor": theme().ink, "linewidth": 1.0, "linestyle": style.DASHES}
            if area.inclusion
            else {"facecolor": style.DANGER, "alpha": 0.06, "edgecolor": "none"}
        )
        if isinstance(area, FenceCircle):
            x, y = frame.from_e7(*area.center)
            axes.add_patch(Circle((x * KM, y * KM), area.radius_m * KM, **look))
        else:
            corners = np.array([frame.from_e7(*corner) for corner in area.vertices]) * KM
            axes.add_patch(Polygon(corners, **look))


def _rim(fence: Fence, frame: LocalFrame) -> FloatArray:
    """(n, 2) corners of the polygons to stay in."""
    polygons = [area for area in fence.areas if area.inclusion and not isinstance(area, FenceCircle)]
    corners = [frame.from_e7(*corner) for area in polygons for corner in area.vertices]
    return np.array(corners).reshape(-1, 2)


def _handles(names: Sequence[str], colours: Sequence[str]) -> list[object]:
    return [
        *(style.line_handle(name, color=colour) for name, colour in zip(names, colours, strict=True)),
        style.line_handle("home", marker="s", **_home(), color=theme().faint),
        style.line_handle("rally point", marker="^", **_rally()),
        style.line_handle(
            "acceptance, circles", marker="o", markersize=9, color=theme().ink, linestyle="", fillstyle="none"
        ),
        style.line_handle("fence: stay in", color=theme().ink, linewidth=1.0, linestyle=style.DASHES),
    ]


def _home() -> dict[str, Any]:
    return {"markersize": 9, "markeredgecolor": theme().ink, "linestyle": "", "zorder": 4}


def _rally() -> dict[str, Any]:
    face, edge = theme().paper, theme().ink
    return {"markersize": 5, "markerfacecolor": face, "markeredgecolor": edge, "linestyle": "", "zorder": 5}
