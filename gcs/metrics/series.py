"""Figures of merit over time, as the pictures show them."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from gcs.metrics.formation_error import FormationError
from gcs.metrics.schedule import Schedule, schedule
from gcs.metrics.separation import least_separation_m
from gcs.metrics.tracks import Tracks
from missions.reference import Reference

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Series:
    """One flight over time, from launch to the last planned arrival. What only pictures show is computed when asked
    for.

    Attributes:
        tracks: positions, and the ticks that the arrays below are of.
        error: of the formation.
        separation_m: (n_tick,) the least between any two vehicles; NaN for fewer than two.
        references, arrivals_s: what each vehicle was to fly, and when it arrived by the swarm's clock, by sysid.
    """

    tracks: Tracks
    error: FormationError
    separation_m: FloatArray
    references: Mapping[int, Reference]
    arrivals_s: Mapping[int, float | None]

    @cached_property
    def planned_separation_m(self) -> FloatArray:
        """(n_tick,) the least between any two vehicles of the plan that are not lost; NaN for fewer than two."""
        tracks = self.tracks
        return least_separation_m(np.where(np.isnan(tracks.flown_m), np.nan, tracks.planned_m))

    @cached_property
    def schedule(self) -> Schedule:
        """Progress along the paths, at fewer times."""
        return schedule(self.tracks, self.references, self.arrivals_s)
