"""The fitness of all UAVs over the iterations of their searches, with a zoom: the paper's figures 8 and 12."""

from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes

from gcs.figures import style
from gcs.theme import theme
from missions.scenario import Scenario
from planner.reproduction import Outcome

FloatArray = npt.NDArray[np.float64]

REPORTED_KM = (20.0, 30.0)
"""What the paper reports for its hybrid."""
ZOOM_FRAME = (0.34, 0.46, 0.64, 0.52)
"""Of the zoom, in shares of the axes."""
BELOW_ZOOM = 0.38
"""Part of the axes' height that is left free of it and of its labels."""
ZOOM_FROM = 0.1
"""Of the iterations."""
NEAR = 0.06
"""The zoom shows those that end within this part of the lowest."""


def draw_fitness(scenario: Scenario, outcome: Outcome, particles: int, seed: int, headline: str, path: Path) -> None:
    """Draw the best feasible cost of each UAV.

    Args:
        scenario: whose UAVs.
        outcome: of a method with iterations.
        particles: evaluated before the first iteration.
        seed: row of the outcome, from 0.
        headline: of the page.
        path: of the picture.
    """
    iterations = outcome.entrant.iterations
    assert iterations is not None
    steps = np.arange(iterations)
    after = particles + steps * (outcome.entrant.evaluations // iterations)
    costs_km = outcome.best_after_km(after)[seed]
    with style.page(path, 5.6) as figure:
        axes = figure.subplots()
        zoom = axes.inset_axes(ZOOM_FRAME)
        _curves(axes, scenario, steps, costs_km)
        _curves(zoom, scenario, steps, costs_km)
        axes.axhspan(*REPORTED_KM, color=theme().faint, alpha=0.18, linewidth=0)
        leader = scenario.vehicles[0]
        line_km = float(np.linalg.norm(np.subtract(scenario.target_m(leader), scenario.origin_m(leader)))) / 1000.0
        axes.axhline(line_km, color=theme().ink, linewidth=1.0, linestyle=style.DASHES)
        axes.set_title("Best feasible f so far")
        axes.set_xlabel("iteration")
        axes.set_ylabel("fitness f (km)")
        axes.set_xlim(0, iterations)
        axes.set_ylim(bottom=REPORTED_KM[0])
        axes.yaxis.set_major_formatter("{x:g}")
        _place_zoom(axes, zoom, costs_km)
        style.headline(figure, headline)
        style.legend_beside(
            figure,
            [
                *style.vehicle_handles(scenario),
                style.line_handle("leader's straight\nline, which no\npath can beat", color=theme().ink, linewidth=1.0,
                                  linestyle=style.DASHES),
                style.line_handle("20 to 30, which\nthe paper reports", color=theme().faint, alpha=0.4, linewidth=8),
            ],
        )  # fmt: skip


def _curves(axes: Axes, scenario: Scenario, steps: npt.NDArray[np.int64], costs_km: FloatArray) -> None:
    colours = style.vehicle_colours(scenario)
    for vehicle, costs in zip(scenario.vehicles, costs_km, strict=True):
        known = np.isfinite(costs)
        axes.step(steps[known], costs[known], where="post", color=colours[vehicle.sysid])


def _place_zoom(axes: Axes, zoom: Axes, costs_km: FloatArray) -> None:
    """Show how the lowest curves end; there are none when no UAV has a feasible path."""
    lowest = float(costs_km[:, -1].min())
    if not np.isfinite(lowest):
        zoom.remove()
        return
    iterations = costs_km.shape[1]
    begin = int(ZOOM_FROM * iterations)
    shown = costs_km[costs_km[:, -1] <= lowest * (1.0 + NEAR), begin:]
    high = float(shown[np.isfinite(shown)].max())
    room = 0.05 * (high - lowest) + 0.01
    zoom.set_xlim(begin, iterations)
    zoom.set_ylim(lowest - room, high + room)
    zoom.tick_params(labelsize=9)
    for spine in zoom.spines.values():
        spine.set_visible(True)
    # All that goes on under the zoom stays below it.
    below = costs_km[:, int(ZOOM_FRAME[0] * iterations) :]
    highest = float(below[np.isfinite(below)].max())
    bottom, top = axes.get_ylim()
    axes.set_ylim(bottom, max(top, bottom + (highest - bottom) / BELOW_ZOOM))
    axes.indicate_inset_zoom(zoom, edgecolor=theme().faint)
