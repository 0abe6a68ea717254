"""What a campaign came to: distributions over its flights, value by value of what varied."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes as Panel
from matplotlib.ticker import LogFormatter

from gcs.campaign.axes import ARM, cell_of, labels
from gcs.campaign.campaign import Campaign
from gcs.campaign.summary import numbers
from gcs.campaign.table import Row, Table
from gcs.figures import style
from gcs.figures.arms import LOOKS
from gcs.theme import theme

PANELS = (
    ("rms_error_m", "Formation error, RMS", "error (m)", True),
    ("min_separation_m", "Least separation", "distance (m)", False),
    ("arrival_spread_s", "Arrival spread", "time (s)", True),
)
"""Column, title, label of the axis, and whether its axis is logarithmic."""
WHISKERS = (5, 95)
"""Per cent."""


def draw_campaign(campaign: Campaign, table: Table, folder: Path) -> list[Path]:
    """Draw a picture for each axis with several values, or one of all flights where there is none; returns the files.
    Raises OSError."""
    rows = [row for case in campaign.cases() if (row := table.row_of(case))]
    varied = [key for key, values in campaign.axes.items() if len(values) > 1]
    if ARM in varied and len(varied) > 1:
        varied.remove(ARM)  # shown by colours beside the others
    shown: list[str | None] = [*varied] or [None]
    files = []
    for key in shown:
        path = folder / f"campaign-{(key or 'all').replace('.', '-')}.png"
        _draw_axis(campaign, rows, key, path)
        files.append(path)
    return files


def _draw_axis(campaign: Campaign, rows: Sequence[Row], key: str | None, path: Path) -> None:
    """Boxes of all flights for each value of an axis, and of each arm beside each other where it varies as well."""
    values = [""] if key is None else [cell_of(value) for value in campaign.axes[key]]
    arms = [arm for arm in LOOKS if arm in campaign.axes.get(ARM, ())]
    if key == ARM or len(arms) < 2:
        arms = []
    with style.page(path, 7.4) as figure:
        panels = figure.subplots(len(PANELS), 1, sharex=True)
        for panel, (column, title, unit, logarithmic) in zip(panels, PANELS, strict=True):
            for i, arm in enumerate(arms or [None]):
                mine = [row for row in rows if arm is None or row[ARM] == arm]
                groups = [
                    numbers([row for row in mine if key is None or row[key] == value], column) for value in values
                ]
                width = 0.7 / max(1, len(arms))
                offset = (i - (max(1, len(arms)) - 1) / 2) * width
                colour = LOOKS[arm][1] if arm is not None else style.VEHICLES[0]
                _boxes(panel, groups, offset, 0.8 * width, colour)
            panel.set_title(title)
            panel.set_ylabel(unit)
            if logarithmic:
                panel.set_yscale("log")
                panel.yaxis.set_major_formatter("{x:g}")
                panel.yaxis.set_minor_formatter(LogFormatter(minor_thresholds=(1.0, 0.5)))
            panel.grid(visible=False, axis="x")
        panels[1].axhline(campaign.scenario.limits.separation_m, color=style.DANGER, linewidth=1.4)
        panels[-1].set_xticks(range(len(values)), values if key is None else list(labels(campaign.axes[key]).values()))
        panels[-1].set_xlim(-0.6, len(values) - 0.4)
        if key is not None:
            panels[-1].set_xlabel(key)
        figure.align_ylabels()
        style.headline(figure, f"{campaign.scenario.name}: {len(rows)} flights")
        handles = [style.line_handle(LOOKS[arm][0], color=LOOKS[arm][1], linewidth=5) for arm in arms]
        handles += [
            style.line_handle("median, quartiles,\n5 and 95 %; extremes", color=theme().ink),
            style.line_handle(f"safe: {campaign.scenario.limits.separation_m:g} m", color=style.DANGER),
        ]
        style.legend_beside(figure, handles)


def _boxes(panel: Panel, groups: Sequence[npt.NDArray[np.float64]], offset: float, width: float, colour: str) -> None:
    """Box plots side by side."""
    panel.boxplot(
        groups,
        positions=[i + offset for i in range(len(groups))],
        widths=width,
        whis=WHISKERS,
        manage_ticks=False,
        patch_artist=True,
        boxprops={"facecolor": colour, "alpha": 0.55, "linewidth": 0.8},
        medianprops={"color": theme().ink, "linewidth": 1.4},
        flierprops={"marker": ".", "markersize": 3, "markerfacecolor": colour, "markeredgecolor": colour},
    )
