"""The figures of merit over time."""

import numpy as np
import numpy.typing as npt
import viser
from viser import uplot

from gcs.console.moment import Course

FloatArray = npt.NDArray[np.float64]

HEIGHT_PX = 150
INK = "#8a8a8a"
"""Readable on white and on black."""
GRID = "rgba(128,128,128,0.2)"
KINDS = (
    ("error_m", "formation error (m)", "#0072b2"),
    ("separation_m", "least separation (m)", "#d55e00"),
    ("delay_s", "age of corrections (s)", "#009e73"),
)


class Plots:
    """Curves in a panel, over simulated time.

    Args:
        gui: to add them to, in the container that is open.
        duration_s: of a flight that is over; None while it goes on.
    """

    def __init__(self, gui: viser.GuiApi, duration_s: float | None) -> None:
        self._shown = -1
        x = uplot.Scale(time=False) if duration_s is None else uplot.Scale(time=False, range=(0.0, duration_s))
        self._charts = {
            key: gui.add_uplot(
                data=_data(Course(), key),
                series=(uplot.Series(label="t (s)"), uplot.Series(label=title, stroke=colour, width=2)),
                title=title,
                scales={"x": x, "y": uplot.Scale(auto=True)},
                axes=(_axis(26), _axis(50)),
                legend=uplot.Legend(show=False),
                height=HEIGHT_PX,
            )
            for key, title, colour in KINDS
        }

    def show(self, course: Course) -> None:
        """Renew them, if there is anything new."""
        if course.now == self._shown:
            return
        self._shown = course.now
        for key, chart in self._charts.items():
            chart.data = _data(course, key)


def _axis(size_px: int) -> uplot.Axis:
    return uplot.Axis(stroke=INK, grid={"stroke": GRID}, ticks={"stroke": GRID}, size=size_px)


def _data(course: Course, key: str) -> tuple[FloatArray, FloatArray]:
    """Times and values so far, where there are any; uPlot takes no NaN."""
    values: FloatArray = getattr(course, key)[: course.now]
    known = np.isfinite(values)
    return course.t_s[: course.now][known], values[known]
