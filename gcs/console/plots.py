"""The figures of merit over time."""

import numpy as np
import numpy.typing as npt
import viser
from viser import uplot

from gcs.console.moment import Course

FloatArray = npt.NDArray[np.float64]

HEIGHT_PX = 135
INK = "#8a8a8a"
"""Readable on white and on black."""
GRID = "rgba(128,128,128,0.2)"
KINDS = (
    ("error_m", "formation error (m)", "#0072b2"),
    ("separation_m", "least separation (m)", "#d55e00"),
    ("delay_s", "age of corrections (s)", "#009e73"),
)
NOTHING = (np.array([0.0, 1e-3]), np.array([0.0, 0.0]))
"""A curve too short to be seen: of a recording at its beginning."""


class Plots:
    """Curves in a panel, over simulated time; each comes when it has two points, since uPlot never gets over fewer.

    Args:
        gui: of the page.
        tab: to add them to.
        duration_s: of a flight that is over; None while it goes on.
    """

    def __init__(self, gui: viser.GuiApi, tab: viser.GuiTabHandle, duration_s: float | None) -> None:
        self._gui = gui
        self._tab = tab
        self._duration_s = duration_s
        self._shown = -1
        self._charts: dict[str, viser.GuiUplotHandle] = {}

    def show(self, course: Course) -> None:
        """Renew them, if there is anything new."""
        if course.now == self._shown:
            return
        self._shown = course.now
        for order, (key, title, colour) in enumerate(KINDS):
            data = _data(course, key)
            if key in self._charts:
                self._charts[key].data = data if len(data[0]) > 1 else NOTHING
            elif len(data[0]) > 1:
                with self._tab:
                    self._charts[key] = self._chart(data, title, colour, order)

    def _chart(self, data: tuple[FloatArray, FloatArray], title: str, colour: str, order: int) -> viser.GuiUplotHandle:
        over = self._duration_s
        return self._gui.add_uplot(
            data=data,
            series=(uplot.Series(label="t (s)"), uplot.Series(label=title, stroke=colour, width=2)),
            title=title,
            scales={
                "x": uplot.Scale(time=False) if over is None else uplot.Scale(time=False, range=(0.0, over)),
                "y": uplot.Scale(auto=True),
            },
            axes=(_axis(26), _axis(50)),
            legend=uplot.Legend(show=False),
            height=HEIGHT_PX,
            padding=(10, 24, 0, 0),
            order=float(order),
        )


def _axis(size_px: int) -> uplot.Axis:
    return uplot.Axis(stroke=INK, grid={"stroke": GRID}, ticks={"stroke": GRID}, size=size_px)


def _data(course: Course, key: str) -> tuple[FloatArray, FloatArray]:
    """Times and values so far, where there are any; uPlot takes no NaN."""
    values: FloatArray = getattr(course, key)[: course.now]
    known = np.isfinite(values)
    return course.t_s[: course.now][known], values[known]
