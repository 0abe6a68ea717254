"""How far each vehicle is along its path, and how far ahead of its plan."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gcs.metrics.tracks import Tracks
from missions.reference import Reference

FloatArray = npt.NDArray[np.float64]

SAMPLES = 600
"""In time: enough for a picture."""
STEP_M = 10.0
"""Between points of the path that a position is first compared with; the projection is then exact on the tangent."""
REACH_M = 5000.0
"""Where a path comes near itself, only places this close to the planned one count."""


@dataclass(frozen=True)
class Schedule:
    """Progress over time, rows in order of sysid; NaN where a vehicle is not known or has arrived.

    Attributes:
        t_s: (n,).
        planned_m: (n_uav, n) planned arc length s_ref.
        deviation_m: (n_uav, n) e = s - s_ref, positive ahead of plan.
        length_m: (n_uav,) of the paths.
    """

    t_s: FloatArray
    planned_m: FloatArray
    deviation_m: FloatArray
    length_m: FloatArray


def schedule(tracks: Tracks, references: Mapping[int, Reference], arrivals_s: Mapping[int, float | None]) -> Schedule:
    """Project what was flown on what was planned, at some `SAMPLES` times."""
    ticks = np.unique(np.linspace(0, len(tracks.t_s) - 1, SAMPLES).astype(np.int64))
    t_s = tracks.t_s[ticks]
    planned = np.full((len(tracks.sysids), len(ticks)), np.nan)
    deviation = np.full_like(planned, np.nan)
    for i, sysid in enumerate(tracks.sysids):
        reference = references[sysid]
        planned[i] = np.where(t_s <= reference.duration_s, reference.arc_lengths(t_s), np.nan)
        arrival_s = arrivals_s.get(sysid)
        known = np.isfinite(tracks.flown_m[i, ticks, 0]) & np.isfinite(planned[i])
        if arrival_s is not None:
            known &= t_s <= arrival_s
        deviation[i, known] = along_path_m(tracks.flown_m[i, ticks[known]], planned[i, known], reference)
        deviation[i, known] -= planned[i, known]
    return Schedule(t_s, planned, deviation, np.array([references[sysid].length_m for sysid in tracks.sysids]))


def along_path_m(positions_m: FloatArray, near_m: FloatArray, reference: Reference) -> FloatArray:
    """Arc length (n,) of the points of a path nearest in plan to positions (n, 3), looked for around `near_m` (n,)."""
    s = np.arange(0.0, reference.length_m + STEP_M, STEP_M)
    x, y, heading, _ = reference.path.at(s)
    squares = (positions_m[:, :1] - x) ** 2 + (positions_m[:, 1:2] - y) ** 2
    squares[np.abs(near_m[:, None] - s) > REACH_M] = np.inf
    nearest = np.argmin(squares, axis=1)
    ahead = (positions_m[:, 0] - x[nearest]) * np.cos(heading[nearest])
    ahead += (positions_m[:, 1] - y[nearest]) * np.sin(heading[nearest])
    result: FloatArray = s[nearest] + np.clip(ahead, -STEP_M, STEP_M)
    return result
