"""What the corrections are worth: the same plan flown with more and less of the formation law."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import numpy.typing as npt

from gcs.figures import style
from gcs.metrics.formation_error import FormationError
from missions.scenario import Scenario
from sitl.config import Arm
from sitl.ticks import TICK_S

LOOKS: Mapping[Arm, tuple[str, str]] = {
    "plain": ("plain autopilot", style.VEHICLES[1]),
    "own_schedule": ("own schedule only", style.VEHICLES[3]),
    "full": ("with neighbours", style.VEHICLES[0]),
}
WINDOW_S = 4.0
"""The errors are shown as RMS over so long, so that three curves can be told apart."""


def draw_arms(scenario: Scenario, errors: Mapping[Arm, FormationError], path: Path) -> None:
    """Draw the formation error of several flights over time; the scale is logarithmic."""
    with style.page(path, 4.2) as figure:
        axes = figure.subplots()
        handles = []
        for arm, (label, colour) in LOOKS.items():
            if arm not in errors:
                continue
            t_s, rms_m = _smoothed(errors[arm].rms_m)
            axes.plot(t_s, rms_m, color=colour)
            handles.append(style.line_handle(f"{label}\n{errors[arm].overall_rms_m:.2g} m RMS", color=colour))
        axes.set_yscale("log")
        axes.set_xlabel("time since launch (s)")
        axes.set_ylabel("formation error (m)")
        axes.yaxis.set_major_formatter("{x:g}")
        axes.margins(x=0.0)
        axes.set_xlim(left=0.0)
        style.headline(figure, f"{scenario.name}: what the corrections are worth")
        style.legend_beside(figure, handles)


def _smoothed(rms_m: npt.NDArray[np.float64]) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """Middle times and RMS of whole windows."""
    ticks = round(WINDOW_S / TICK_S)
    windows = rms_m[: len(rms_m) // ticks * ticks].reshape(-1, ticks)
    t_s = (np.arange(len(windows), dtype=np.float64) + 0.5) * WINDOW_S
    return t_s, np.asarray(np.sqrt(np.mean(windows**2, axis=1)))
