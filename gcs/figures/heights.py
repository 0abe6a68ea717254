"""Height profiles: each planned way over the ground below it, with the clearance that is asked for."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.patches import Patch

from gcs.figures import style
from gcs.figures.style import KM
from gcs.theme import theme
from missions.environment import ground_heights_m
from missions.reference import Reference
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan

FloatArray = npt.NDArray[np.float64]

STEP_M = 10.0
SHOWN = 9
"""Of more vehicles those are shown that come nearest to the ground."""
COLUMNS = 3
ROW_HEIGHT_IN, REST_IN = 1.9, 1.0
HEADROOM = 0.08
"""Above the highest way and below the lowest ground, as a share of what lies between."""


@dataclass(frozen=True)
class Profile:
    """One way from the side.

    Attributes:
        s_m: (n,) arc lengths.
        way_m, ground_m, lowest_m: (n,) altitudes AMSL of the way, of the ground, and of the lowest that is allowed.
        clearance_m: the least height above ground once the climb-out is over.
    """

    s_m: FloatArray
    way_m: FloatArray
    ground_m: FloatArray
    lowest_m: FloatArray
    clearance_m: float


def profile(reference: Reference, scenario: Scenario) -> Profile:
    """A planned way and what is below it, every `STEP_M`."""
    s_m = np.append(np.arange(0.0, reference.length_m, STEP_M), reference.length_m)
    x, y, z = reference.points(s_m).T
    ground = ground_heights_m(x, y, scenario.environment.terrain)
    limits, above_sea = scenario.limits, scenario.origin.alt_m
    wanted = limits.clearance_m * np.minimum(1.0, s_m / limits.climb_out_m)
    climbed_out = s_m >= min(limits.climb_out_m, reference.length_m)
    clearance_m = float((z - ground)[climbed_out].min())
    return Profile(s_m, z + above_sea, ground + above_sea, ground + wanted + above_sea, clearance_m)


def draw_heights(plan: FormationPlan, scenario: Scenario, path: Path) -> None:
    """Draw a panel a vehicle, all to one scale."""
    profiles = {sysid: profile(one, scenario) for sysid, one in plan.references(scenario).items()}
    shown = sorted(sorted(profiles, key=lambda sysid: profiles[sysid].clearance_m)[:SHOWN])
    rows = math.ceil(len(shown) / COLUMNS)
    with style.page(path, ROW_HEIGHT_IN * rows + REST_IN) as figure:
        panels = figure.subplots(rows, COLUMNS, sharex=True, sharey=True, squeeze=False)
        names, colours = {uav.sysid: uav.name for uav in plan.uavs}, style.vehicle_colours(scenario)
        for sysid, axes in zip(shown, panels.flat, strict=False):
            _panel(axes, profiles[sysid], colours[sysid])
            axes.set_title(f"{sysid} {names[sysid]}: least {profiles[sysid].clearance_m:.0f} m", fontsize=10.5)
        for axes in panels.flat[len(shown) :]:
            axes.set_visible(False)
        _limits(panels[0, 0], {sysid: profiles[sysid] for sysid in shown})
        figure.supxlabel("distance along its way (km)", fontsize=11)
        figure.supylabel("altitude (m AMSL)", fontsize=11)
        which = "" if len(shown) == len(profiles) else f", the {len(shown)} lowest of {len(profiles)}"
        style.headline(
            figure, f"{scenario.name}: planned heights, and the least above ground after the climb-out{which}"
        )
        style.legend_beside(
            figure,
            [
                style.line_handle("planned", color=theme().ink, linewidth=1.8),
                style.line_handle(
                    f"lowest allowed:\n{scenario.limits.clearance_m:g} m above ground\n"
                    f"after {scenario.limits.climb_out_m * KM:g} km",
                    color=style.DANGER,
                    linewidth=1.1,
                    linestyle=style.DASHES,
                ),
                Patch(color=theme().ground[2], label="ground, as in\nthe elevation file"),
            ],
        )


def _panel(axes: Axes, one: Profile, colour: str) -> None:
    km = one.s_m * KM
    axes.fill_between(km, one.ground_m, -1e5, color=theme().ground[2], linewidth=0)
    axes.plot(km, one.lowest_m, color=style.DANGER, linewidth=1.1, linestyle=style.DASHES)
    axes.plot(km, one.way_m, color=colour, linewidth=1.8)


def _limits(axes: Axes, profiles: Mapping[int, Profile]) -> None:
    low = min(float(one.ground_m.min()) for one in profiles.values())
    high = max(float(max(one.way_m.max(), one.ground_m.max())) for one in profiles.values())
    rim = HEADROOM * max(high - low, 1.0)
    axes.set_ylim(low - rim, high + rim)
    axes.set_xlim(0.0, max(float(one.s_m[-1]) for one in profiles.values()) * 1.02 * KM)
