"""Formation error over the delay of the corrections, and where the flight was on that curve."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from gcs.figures import style


def draw_delay_curve(
    scenario: str,
    points: Sequence[tuple[float, float]],
    flown: tuple[float, float] | None,
    margin_s: float,
    path: Path,
) -> None:
    """Draw it.

    Args:
        scenario: its name.
        points: delay, s, and RMS formation error, m.
        flown: the same of the flight.
        margin_s: the delay that the formation bears.
        path: of the picture.
    """
    with style.page(path, 3.8) as figure:
        axes = figure.subplots()
        axes.plot(*zip(*points, strict=True), color=style.VEHICLES[0], marker="o", markersize=4)
        axes.axvline(margin_s, color=style.DANGER, linewidth=1.4)
        handles = [
            style.line_handle("rehearsed", color=style.VEHICLES[0], marker="o", markersize=4),
            style.line_handle(f"margin: {margin_s:.2f} s", color=style.DANGER),
        ]
        if flown is not None:
            look: dict[str, Any] = {"marker": "D", "markersize": 8, "color": style.VEHICLES[3], "linestyle": ""}
            axes.plot(*flown, **look)
            handles.append(style.line_handle("this flight", **look))
        axes.set_title("Formation error by delay")
        axes.set_xlabel("delay (s)")
        axes.set_ylabel("error (m RMS)")
        axes.set_xlim(left=0.0)
        axes.set_ylim(bottom=0.0)
        style.headline(figure, f"{scenario}: the delay that the formation bears")
        style.legend_beside(figure, handles)
