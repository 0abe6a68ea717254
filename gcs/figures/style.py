"""The house style of all pictures: one page, one set of colours, kilometres and seconds on the axes."""

import logging
import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

import matplotlib
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from gcs.theme import theme
from missions.environment import Environment
from missions.scenario import Scenario

_log = logging.getLogger(__name__)

WIDTH_IN = 10.0
DPI = 150
"""1500 pixels wide: sharp in a README, whose column is some 900 wide."""
KM = 1e-3

DANGER = "#c1272d"
RADAR = "#d9822b"
OBSTACLE = "#5b6573"

VEHICLES = ("#5F5AD6", "#CC6677", "#117733", "#DDAA33", "#33AADD", "#B8347C", "#44AA99", "#999933", "#AA4499")
"""P. Tol's "muted" scheme, which colour-blind readers tell apart, its extremes drawn together, for light paper
and dark."""
DASHES = (0, (5, 2.5))
"""What is planned."""

LEGEND_VEHICLES = 20
"""With more, a legend names some of them, evenly: the shades between need no names."""

HOUSE: dict[Any, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 11,
    "axes.titlesize": 12,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 11,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.linewidth": 0.7,
    "xtick.labelsize": 10,
    "ytick.labelsize": 10,
    "legend.frameon": False,
    "legend.fontsize": 10,
    "legend.title_fontsize": 10,
    "lines.linewidth": 1.6,
}


def house() -> dict[Any, Any]:
    """The house style in the colours of the theme."""
    now = theme()
    ink = dict.fromkeys(("axes.labelcolor", "axes.titlecolor", "xtick.color", "ytick.color", "text.color"), now.ink)
    ink |= dict.fromkeys(("lines.color", "patch.edgecolor", "boxplot.flierprops.color"), now.ink)
    ink |= {f"boxplot.{part}props.color": now.ink for part in ("box", "whisker", "cap", "median")}
    paper = dict.fromkeys(("axes.facecolor", "figure.facecolor", "savefig.facecolor"), now.paper)
    return HOUSE | ink | paper | {"axes.edgecolor": now.faint, "grid.color": now.grid}


@contextmanager
def page(
    path: Path, height_in: float, layout: Literal["constrained", "compressed"] | None = "constrained"
) -> Iterator[Figure]:
    """A figure in the house style, written to a PNG file when the block ends. Raises OSError.

    Args:
        path: of the file.
        height_in: of the page.
        layout: "compressed" for axes of a fixed aspect, None for axes that are put in place by hand.
    """
    with matplotlib.rc_context(house()):
        figure = Figure(figsize=(WIDTH_IN, height_in), layout=layout)
        yield figure
        try:
            figure.savefig(path, dpi=DPI)
        except OSError as error:  # a disk that is full does not say where
            raise OSError(error.errno, error.strerror, str(path)) from None
        _log.info("%s drawn", path)


def headline(figure: Figure, text: str) -> None:
    """The title of a whole page, at its left."""
    figure.suptitle(text, x=0.012, horizontalalignment="left", fontsize=13, fontweight="bold")


def vehicle_colours(scenario: Scenario) -> dict[int, Any]:
    """The colour of each vehicle by sysid, the same in every picture of a scenario."""
    sysids = sorted(vehicle.sysid for vehicle in scenario.vehicles)
    return dict(zip(sysids, colours(len(sysids)), strict=True))


def colours(count: int) -> list[Any]:
    """So many, to tell vehicles apart; of one scale where there are too many for that."""
    if count <= len(VEHICLES):
        return list(VEHICLES[:count])
    shades = matplotlib.colormaps["viridis"]
    return [shades(0.95 * i / (count - 1)) for i in range(count)]


def legend_beside(figure: Figure, handles: Sequence[Any]) -> None:
    """A legend right of all axes, where it hides nothing."""
    figure.legend(handles=list(handles), loc="outside right upper", handlelength=1.6)


def vehicle_handles(scenario: Scenario) -> list[Line2D]:
    """Legend entries of the vehicles, in order of sysid."""
    colours = vehicle_colours(scenario)
    every = math.ceil(len(scenario.vehicles) / LEGEND_VEHICLES)
    vehicles = sorted(scenario.vehicles, key=lambda vehicle: vehicle.sysid)[::every]
    return [line_handle(f"{vehicle.sysid} {vehicle.name}", color=colours[vehicle.sysid]) for vehicle in vehicles]


def surroundings_handles(environment: Environment) -> list[Patch]:
    """Legend entries of what stands in the area."""
    handles = []
    if environment.radars:
        handles.append(Patch(color=RADAR, alpha=0.35, label="radar"))
    if environment.obstacles:
        handles.append(Patch(color=OBSTACLE, label="obstacle"))
    return handles


def line_handle(label: str, **look: Any) -> Line2D:
    """A legend entry for a line."""
    return Line2D([], [], label=label, **look)
