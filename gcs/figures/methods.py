"""The paper's comparison of methods, over iterations and over evaluations."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from gcs.figures import style
from planner.reproduction import Outcome, Study
from planner.reproduction.entrants import Equal

FloatArray = npt.NDArray[np.float64]

LOOKS: Mapping[str, str] = {
    "hybrid": style.VEHICLES[0],
    "published": style.VEHICLES[4],
    "pso": style.VEHICLES[1],
    "qpso": style.VEHICLES[2],
    "skein": style.VEHICLES[3],
}
POINTS = 300
"""Of one curve."""
HEADROOM = 0.2
"""How far above the lowest the curves are shown, as a part of it."""


def draw_methods(study: Study, headline: str, path: Path) -> None:
    """Draw median and quartiles, over the seeds, of the sum of all UAVs' best costs."""
    with style.page(path, 4.6) as figure:
        left, right = figure.subplots(1, 2, sharey=True)
        lowest = [_curves(left, study, "iterations"), _curves(right, study, "evaluations")]
        left.set_title("At equal iterations")
        left.set_xlabel("iteration")
        left.set_ylabel(f"sum of f of {len(study.scenario.vehicles)} UAVs (km)")
        right.set_title("At equal evaluations")
        right.set_xlabel("evaluations for each UAV")
        right.xaxis.set_major_locator(MaxNLocator(4))
        if np.isfinite(min(lowest)):
            left.set_ylim(0.99 * min(lowest), (1.0 + HEADROOM) * min(lowest))
        style.headline(figure, headline)
        style.legend_beside(figure, [style.line_handle(method, color=colour) for method, colour in LOOKS.items()])


def _curves(axes: Axes, study: Study, equal: Equal) -> float:
    """Draw whoever has something in common with the hybrid; returns the lowest median."""
    lowest = np.inf
    for outcome in study.outcomes:
        entrant = outcome.entrant
        if equal not in entrant.equal:
            continue
        evaluations = np.linspace(0.0, entrant.evaluations, POINTS)
        first, median, third = _quartiles(outcome, evaluations)
        each = entrant.evaluations / entrant.iterations if equal == "iterations" and entrant.iterations else 1.0
        axes.fill_between(evaluations / each, first, third, color=LOOKS[entrant.method], alpha=0.2, linewidth=0)
        axes.plot(evaluations / each, median, color=LOOKS[entrant.method])
        lowest = min(lowest, float(median[-1]) if np.isfinite(median[-1]) else np.inf)
        axes.set_xlim(0.0, entrant.evaluations / each)
    return lowest


def _quartiles(outcome: Outcome, evaluations: FloatArray) -> Sequence[FloatArray]:
    """Of the totals over the seeds; NaN where a quarter, half or three quarters of them are infinite."""
    totals = outcome.best_after_km(evaluations).sum(axis=1)
    places = np.quantile(totals, (0.25, 0.5, 0.75), axis=0, method="inverted_cdf")
    return [np.where(np.isfinite(place), place, np.nan) for place in places]
