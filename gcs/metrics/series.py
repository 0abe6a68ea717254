"""Figures of merit over time, as the pictures show them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gcs.metrics.formation_error import Edge, FormationError, formation_error
from gcs.metrics.schedule import Schedule, schedule
from gcs.metrics.separation import least_separation_m
from gcs.metrics.tracks import Tracks
from missions.reference import Reference

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Series:
    """One flight over time, from launch to the last planned arrival.

    Attributes:
        tracks: positions, and the ticks that the arrays below are of.
        error: of the formation.
        separation_m: (n_tick,) the least between any two vehicles; NaN for fewer than two.
        planned_separation_m: (n_tick,) the same of the plan.
        schedule: progress along the paths, at fewer times.
    """

    tracks: Tracks
    error: FormationError
    separation_m: FloatArray
    planned_separation_m: FloatArray
    schedule: Schedule


def flight_series(
    tracks: Tracks,
    edges: Sequence[Edge],
    references: Mapping[int, Reference],
    arrivals_s: Mapping[int, float | None],
) -> Series:
    """Compute what is shown over time."""
    return Series(
        tracks=tracks,
        error=formation_error(tracks, edges),
        separation_m=least_separation_m(tracks.flown_m),
        planned_separation_m=least_separation_m(tracks.planned_m),
        schedule=schedule(tracks, references, arrivals_s),
    )
