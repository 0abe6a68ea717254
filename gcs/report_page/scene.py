"""The scene in three dimensions, for a page: to be turned, zoomed, and asked what a point is."""

from typing import Any

import numpy as np
import numpy.typing as npt
import plotly.graph_objects as go

from gcs.figures import style
from gcs.figures.paths import Ground, flown_paths, ground_below, planned_paths
from gcs.figures.scene import EXAGGERATIONS, HEIGHT_SHARE, TURNS
from gcs.figures.style import KM
from gcs.report_page.flown_run import FlownRun
from gcs.theme import LIGHT
from missions.environment import Environment

FloatArray = npt.NDArray[np.float64]

HEIGHT_PX = 560
RISE = np.linspace(0.0, np.pi, 19)
"""From the top of a sphere to its bottom."""
TICKS = "#8a8a8a"
"""Readable on white and on black."""


def scene_html(run: FlownRun, name: str) -> str:
    """The scene as an element of a page that has plotly.js.

    Args:
        run: that was flown.
        name: of the element.
    """
    references = run.plan.references(run.scenario)
    planned, flown = planned_paths(references), flown_paths(run.truths, references)
    environment = run.scenario.environment
    ground = ground_below(planned, environment)
    traces = [_ground(ground), *_radars(environment, ground), *_obstacles(environment, ground)]
    colours = style.vehicle_colours(run.scenario)
    names = {vehicle.sysid: f"{vehicle.sysid} {vehicle.name}" for vehicle in run.scenario.vehicles}
    for sysid, points in planned.items():
        look = {"color": _css(colours[sysid]), "width": 2, "dash": "dash"}
        traces.append(_line(points, f"{names[sysid]}, planned", look, group=str(sysid), in_legend=False))
    for sysid, points in flown.items():
        look = {"color": _css(colours[sysid]), "width": 5}
        traces.append(_line(points, names[sysid], look, group=str(sysid), in_legend=True))
        traces.append(_end(points, names[sysid], _css(colours[sysid]), group=str(sysid)))
    figure = go.Figure(traces, _layout(ground, max(float(points[:, 2].max()) for points in planned.values())))
    html: str = figure.to_html(
        full_html=False,
        include_plotlyjs=False,
        div_id=name,
        default_height=f"{HEIGHT_PX}px",
        config={"displaylogo": False, "responsive": True},
    )
    return html


def _layout(ground: Ground, highest_m: float) -> go.Layout:
    x0, x1, y0, y1 = ground.extent_m
    longer = max(x1 - x0, y1 - y0)
    height_m = max(highest_m, float(ground.z_m.max())) - float(ground.z_m.min())
    factor = max(one for one in EXAGGERATIONS if one == 1 or one * height_m <= HEIGHT_SHARE * longer)

    def axis(title: str) -> dict[str, Any]:
        return {"title": title, "showbackground": False, "gridcolor": TICKS, "color": TICKS}

    return go.Layout(
        scene={
            "aspectmode": "manual",
            "aspectratio": {
                "x": 1.6 * (x1 - x0) / longer,
                "y": 1.6 * (y1 - y0) / longer,
                "z": 1.6 * factor * height_m / longer,
            },
            "xaxis": axis("east x (km)"),
            "yaxis": axis("north y (km)"),
            "zaxis": axis(f"altitude z (m), {factor}x" if factor > 1 else "altitude z (m)"),
            "camera": {"eye": {"x": -0.95, "y": -1.6, "z": 1.0}, "center": {"x": 0.0, "y": 0.0, "z": -0.25}},
        },
        margin={"l": 0, "r": 0, "t": 32, "b": 0},  # above it, the buttons
        legend={"font": {"color": TICKS}, "groupclick": "togglegroup"},
        paper_bgcolor="rgba(0,0,0,0)",
    )


def _ground(ground: Ground) -> Any:
    shares = np.linspace(0.0, 1.0, len(LIGHT.ground))
    scale = [[float(share), colour] for share, colour in zip(shares, LIGHT.ground, strict=True)]
    return go.Surface(
        x=_rounded(ground.x_m * KM, 3),
        y=_rounded(ground.y_m * KM, 3),
        z=_rounded(ground.z_m, 1),
        colorscale=[scale[0], [1.0, LIGHT.ground[0]]] if ground.level else scale,
        showscale=False,
        contours={"z": {"show": not ground.level, "color": LIGHT.faint, "width": 1}},
        hovertemplate="ground %{z:.0f} m<extra></extra>",
        name="ground",
    )


def _radars(environment: Environment, ground: Ground) -> list[Any]:
    low_m = float(ground.z_m.min())
    return [
        go.Surface(
            x=_rounded((radar.x_m + radar.radius_m * np.outer(np.cos(TURNS), np.sin(RISE))) * KM, 3),
            y=_rounded((radar.y_m + radar.radius_m * np.outer(np.sin(TURNS), np.sin(RISE))) * KM, 3),
            z=_rounded(np.maximum(radar.z_m + radar.radius_m * np.outer(np.ones_like(TURNS), np.cos(RISE)), low_m), 1),
            colorscale=[[0.0, style.RADAR], [1.0, style.RADAR]],
            opacity=0.28,
            showscale=False,
            hovertemplate="radar<extra></extra>",
            name="radar",
        )
        for radar in environment.radars
    ]


def _obstacles(environment: Environment, ground: Ground) -> list[Any]:
    """Cylinders with a roof, from the lowest ground that is drawn."""
    low_m = float(ground.z_m.min())
    radii = np.array([1.0, 1.0, 0.0])
    return [
        go.Surface(
            x=_rounded((obstacle.x_m + obstacle.radius_m * np.outer(radii, np.cos(TURNS))) * KM, 3),
            y=_rounded((obstacle.y_m + obstacle.radius_m * np.outer(radii, np.sin(TURNS))) * KM, 3),
            z=_rounded(np.outer([low_m, obstacle.top_m, obstacle.top_m], np.ones_like(TURNS)), 1),
            colorscale=[[0.0, style.OBSTACLE], [1.0, style.OBSTACLE]],
            showscale=False,
            hovertemplate="obstacle<extra></extra>",
            name="obstacle",
        )
        for obstacle in environment.obstacles
    ]


def _line(points: FloatArray, name: str, look: dict[str, Any], *, group: str, in_legend: bool) -> Any:
    return go.Scatter3d(
        x=_rounded(points[:, 0] * KM, 4),
        y=_rounded(points[:, 1] * KM, 4),
        z=_rounded(points[:, 2], 1),
        mode="lines",
        line=look,
        name=name,
        legendgroup=group,
        showlegend=in_legend,
        hovertemplate="x %{x:.2f} km, y %{y:.2f} km, %{z:.0f} m<extra>" + name + "</extra>",
    )


def _end(points: FloatArray, name: str, colour: str, *, group: str) -> Any:
    x, y, z = points[-1]
    return go.Scatter3d(
        x=[x * KM],
        y=[y * KM],
        z=[z],
        mode="markers",
        marker={"color": colour, "size": 4, "symbol": "diamond"},
        legendgroup=group,
        showlegend=False,
        hovertemplate="end of the flight<extra>" + name + "</extra>",
    )


def _rounded(values: FloatArray, decimals: int) -> list[Any]:
    """As few digits as the eye can see, in the page's text."""
    found: list[Any] = np.round(values, decimals).tolist()
    return found


def _css(colour: Any) -> str:
    if isinstance(colour, str):
        return colour
    red, green, blue = (round(255 * share) for share in colour[:3])
    return f"rgb({red},{green},{blue})"
