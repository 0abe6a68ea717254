"""The pictures of a study of delay: the linear law, aircraft, channels, pins, and a line."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from gcs.figures import style
from gcs.figures.arms import LOOKS
from gcs.study.linear_sweep import BARE, FLOWN, PIN_ALL, PIN_ONE, TICKS, Amplification, Growth
from gcs.study.points import Point, on_curve
from gcs.theme import theme

LAWS = {
    BARE: ("bare law,\nunit weights", style.VEHICLES[0], "o", "-"),
    FLOWN: ("law as flown", style.VEHICLES[2], "s", "-"),
    TICKS: ("law as flown,\nin ticks", style.VEHICLES[3], "x", style.DASHES),
}
ROWS = (
    ("rms_error_m", "formation\nerror (m)", 1.0),
    ("relative_speed_m_s", "relative\nspeed (m/s)", 1.0),
    ("saturated", "thrust\nsaturated (%)", 100.0),
    ("effort_n_s", "control\neffort (N/s)", 1.0),
)
"""Measure, label, and units a unit of it."""
PINS = {PIN_ALL: ("all pinned", style.VEHICLES[0]), PIN_ONE: ("one pinned", style.VEHICLES[1])}
CHANNELS = (
    ("jitter", "jitter, up to (s)"),
    ("loss", "loss (share of samples)"),
    ("bursts", "bursts and gaps, mean length (s)"),
)


def draw_linear(scenario: str, growths: Sequence[Growth], path: Path) -> None:
    """Growth of a disturbance over delay, in shares of the margin, a panel for each graph. Raises OSError."""
    graphs = list(dict.fromkeys(growth.graph for growth in growths))
    with style.page(path, 6.4) as figure:
        panels = figure.subplots(2, -(-(len(graphs) + 1) // 2), sharex=True, squeeze=False).flat
        for axes, graph in zip(panels, graphs, strict=False):
            for law, (_, colour, marker, dashes) in LAWS.items():
                mine = [growth for growth in growths if (growth.graph, growth.law) == (graph, law)]
                axes.plot(
                    [growth.share for growth in mine],
                    [growth.rate_1_s for growth in mine],
                    color=colour,
                    marker=marker,
                    markersize=3.5,
                    linewidth=1.2,
                    linestyle=dashes,
                )
            _edge_of_stability(axes)
            axes.set_title(graph)
            axes.set_xlim(0.5, 1.5)
            axes.set_xlabel("delay / margin τ*")
            axes.set_ylabel("growth (1/s)")
            axes.tick_params(labelbottom=True)
        for axes in list(panels)[len(graphs) :]:
            axes.set_visible(False)
        for axes in figure.axes[len(graphs) :]:
            axes.set_visible(False)
        style.headline(figure, f"{scenario}: what disturbs the linear formation dies out below τ*, and grows above it")
        handles = [
            style.line_handle(label, color=colour, marker=marker, markersize=4, linestyle=dashes)
            for label, colour, marker, dashes in LAWS.values()
        ]
        figure.legend(handles=[*handles, _margin_handle()], loc="lower right", bbox_to_anchor=(0.97, 0.16))


def draw_aircraft(
    scenario: str, points: Sequence[Point], margins_s: Mapping[str, float], delay_s: float, path: Path
) -> None:
    """What aircraft do over delay, a column for each graph. Raises OSError.

    Args:
        points: curves (graph, arm) over delay.
        margins_s: the aircraft's margin by graph.
        delay_s: the scenario's.
    """
    with style.page(path, 8.6) as figure:
        grid = figure.subplots(len(ROWS), len(margins_s), sharex="col", sharey="row", squeeze=False)
        for column, (graph, margin_s) in enumerate(margins_s.items()):
            for row, (measure, label, scale) in enumerate(ROWS):
                axes = grid[row, column]
                full = on_curve(points, graph, "full")
                _curve(axes, full, measure, scale, LOOKS["full"][1])
                for arm in ("own_schedule", "plain"):
                    _level(axes, on_curve(points, graph, arm)[0], measure, scale, LOOKS[arm][1])
                axes.axvline(margin_s, color=style.DANGER, linewidth=1.2)
                axes.axvline(delay_s, color=theme().faint, linewidth=1.0, linestyle=":")
                axes.set_xlim(0.0, full[-1].level)
                if row == 0:
                    axes.set_title(graph)
                    axes.set_yscale("log")
                    axes.yaxis.set_major_formatter("{x:g}")
                if column == 0:
                    axes.set_ylabel(label)
            grid[-1, column].set_xlabel("delay (s)")
        for row in grid[1:, 0]:
            row.set_ylim(bottom=0.0)
        figure.align_ylabels()
        style.headline(figure, f"{scenario}: past τ* aircraft fall into a limit cycle of thrust ({_flights(points)})")
        handles = [style.line_handle(label, color=colour) for label, colour in LOOKS.values()]
        handles += [_margin_handle(), style.line_handle(f"scenario: {delay_s:g} s", color=theme().faint, linestyle=":")]
        figure.legend(handles=handles, loc="outside lower left", ncols=len(handles))


def draw_channels(scenario: str, points: Sequence[Point], delay_s: float, path: Path) -> None:
    """What jitter, loss and bursts do, at one delay. Raises OSError."""
    own = on_curve(points, "own_schedule")[0]
    with style.page(path, 5.6) as figure:
        grid = figure.subplots(2, len(CHANNELS), sharex="col", sharey="row")
        for column, (what, label) in enumerate(CHANNELS):
            for row, (measure, name, scale) in enumerate(ROWS[:2]):
                _curve(grid[row, column], on_curve(points, what), measure, scale, LOOKS["full"][1])
                _level(grid[row, column], own, measure, scale, LOOKS["own_schedule"][1])
                if column == 0:
                    grid[row, column].set_ylabel(name)
            grid[-1, column].set_xlabel(label)
        for axes in grid[:, 0]:
            axes.set_ylim(bottom=0.0)
        grid[0, 2].set_xscale("log")
        grid[0, 2].xaxis.set_major_formatter("{x:g}")
        grid[0, 2].minorticks_off()
        figure.align_ylabels()
        style.headline(figure, f"{scenario}: jitter, loss and bursts at a delay of {delay_s:g} s ({_flights(points)})")
        handles = [style.line_handle(f"{LOOKS[arm][0]}", color=LOOKS[arm][1]) for arm in ("full", "own_schedule")]
        figure.legend(handles=handles, loc="outside lower left", ncols=2)


def draw_pins(scenario: str, growths: Sequence[Growth], points: Sequence[Point], margin_s: float, path: Path) -> None:
    """All pinned against one: the linear law, and aircraft. Raises OSError.

    Args:
        growths: of `pin_growths`, by law "all" and "one".
        points: curves (pinned,) over delay.
        margin_s: the aircraft's, with all pinned.
    """
    with style.page(path, 4.4) as figure:
        left, middle, right = figure.subplots(1, 3)
        for pinned, (_, colour) in PINS.items():
            mine = [growth for growth in growths if growth.law == pinned]
            left.plot([g.delay_s for g in mine], [g.rate_1_s for g in mine], color=colour, marker="o", markersize=3)
            for axes, (measure, name, scale) in zip((middle, right), ROWS[:2], strict=True):
                _curve(axes, on_curve(points, pinned), measure, scale, colour)
                axes.set_title(f"aircraft, {name.split(' (')[0]}".replace("\n", " "))
                axes.set_ylabel(name.replace("\n", " "))
        left.axvline(growths[0].margin_s, color=style.DANGER, linewidth=1.2)
        left.axhline(0.0, color=theme().ink, linewidth=0.8)
        left.set_title("linear law")
        left.set_ylabel("growth (1/s)")
        for axes in (middle, right):
            axes.axvline(margin_s, color=style.DANGER, linewidth=1.2)
            axes.set_ylim(bottom=0.0)
        for axes in (left, middle, right):
            axes.set_xlabel("delay (s)")
        style.headline(figure, f"{scenario}: all pinned to their schedules, and the first alone ({_flights(points)})")
        handles = [style.line_handle(label, color=colour) for label, colour in PINS.values()]
        figure.legend(handles=[*handles, _margin_handle("τ* with all pinned")], loc="outside lower left", ncols=3)


def draw_line(scenario: str, found: Sequence[Amplification], path: Path) -> None:
    """How a disturbance of the first vehicle travels along a line. Raises OSError."""
    with style.page(path, 6.0) as figure:
        grid = figure.subplots(2, 2, sharex=True, sharey="row")
        shares = list(dict.fromkeys(one.share for one in found))
        for column, (pinned, (label, _)) in enumerate(PINS.items()):
            for share, colour in zip(shares, style.VEHICLES, strict=False):
                (one,) = (one for one in found if (one.pinned, one.share) == (pinned, share))
                for axes, gains in zip(grid[:, column], (one.errors_s2, one.speeds_s), strict=True):
                    axes.plot(range(1, len(gains) + 1), gains, color=colour, marker="o", markersize=4)
                    axes.set_xticks(range(1, len(gains) + 1))
            grid[0, column].set_ylim(bottom=0.0)
            grid[1, column].set_yscale("log")
            grid[1, column].yaxis.set_major_formatter("{x:g}")
            grid[0, column].set_title(label)
            grid[1, column].set_xlabel("edge of the line, from the shaken vehicle on")
        grid[0, 0].set_ylabel("largest error\n(m per m/s²)")
        grid[1, 0].set_ylabel("largest relative speed\n(m/s per m/s²)")
        figure.align_ylabels()
        style.headline(figure, f"{scenario}: the first vehicle of a line is shaken; what arrives at each edge")
        handles = [
            style.line_handle(f"delay {share:g} τ*", color=colour, marker="o", markersize=4)
            for share, colour in zip(shares, style.VEHICLES, strict=False)
        ]
        style.legend_beside(figure, handles)


def _edge_of_stability(axes: Axes) -> None:
    axes.axvline(1.0, color=style.DANGER, linewidth=1.2)
    axes.axhline(0.0, color=theme().ink, linewidth=0.8)


def _margin_handle(label: str = "margin τ*") -> Line2D:
    return style.line_handle(label, color=style.DANGER, linewidth=1.2)


def _curve(axes: Axes, points: Sequence[Point], measure: str, scale: float, colour: str) -> None:
    """Means, with their intervals as a band."""
    levels = [point.level for point in points]
    mean = scale * np.array([point.measures[measure].mean for point in points])
    half = scale * np.array([point.measures[measure].half_width for point in points])
    axes.fill_between(levels, mean - half, mean + half, color=colour, alpha=0.25, linewidth=0)
    axes.plot(levels, mean, color=colour, marker="o", markersize=3)


def _level(axes: Axes, point: Point, measure: str, scale: float, colour: str) -> None:
    """What does not depend on what is swept."""
    found = point.measures[measure]
    axes.axhspan(
        scale * (found.mean - found.half_width),
        scale * (found.mean + found.half_width),
        color=colour,
        alpha=0.25,
        linewidth=0,
    )
    axes.axhline(scale * found.mean, color=colour, linewidth=1.4)


def _flights(points: Sequence[Point]) -> str:
    return f"{points[0].flights} seeds, 95 % intervals"
