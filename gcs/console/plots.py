"""The figures of merit over time."""

import numpy as np
import numpy.typing as npt
import viser
from viser import uplot

from gcs.console.moment import Course

FloatArray = npt.NDArray[np.float64]

HEIGHT_PX = 150
AHEAD = "rgba(128,128,128,0.55)"
"""What of a recorded flight is still to come."""
INK = "#8a8a8a"
"""Readable on white and on black."""
GRID = "rgba(128,128,128,0.2)"
KINDS = (("error_m", "formation error (m)", "#0072b2"), ("separation_m", "least separation (m)", "#d55e00"),
         ("delay_s", "delay of corrections (s)", "#009e73"))  # fmt: skip


class Plots:
    """Curves in a panel, over simulated time.

    Args:
        gui: to add them to, in the container that is open.
    """

    def __init__(self, gui: viser.GuiApi) -> None:
        self._shown = (-1, -1)
        self._charts = {
            key: gui.add_uplot(
                data=_data(Course(), key),
                series=(
                    uplot.Series(label="t (s)"),
                    uplot.Series(label=title, stroke=colour, width=2),
                    uplot.Series(label="to come", stroke=AHEAD, width=1),
                ),
                title=title,
                scales={"x": uplot.Scale(time=False), "y": uplot.Scale(auto=True)},
                axes=(
                    uplot.Axis(stroke=INK, grid={"stroke": GRID}, ticks={"stroke": GRID}, size=26),
                    uplot.Axis(stroke=INK, grid={"stroke": GRID}, ticks={"stroke": GRID}, size=46),
                ),
                legend=uplot.Legend(show=False),
                height=HEIGHT_PX,
            )
            for key, title, colour in KINDS
        }

    def show(self, course: Course) -> None:
        """Renew them, if there is anything new."""
        if (course.now, len(course.t_s)) == self._shown:
            return
        self._shown = (course.now, len(course.t_s))
        for key, chart in self._charts.items():
            chart.data = _data(course, key)


def _data(course: Course, key: str) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Times, what was, and what is to come, of as many points each."""
    values: FloatArray = getattr(course, key)
    past = np.arange(len(values)) < course.now
    return course.t_s, np.where(past, values, np.nan), np.where(past, np.nan, values)
