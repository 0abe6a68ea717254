"""The formation error: how far neighbours are from where they should be relative to each other (MODEL, section 6)."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gcs.metrics.tracks import Tracks

FloatArray = npt.NDArray[np.float64]
Edge = tuple[int, int]


@dataclass(frozen=True)
class FormationError:
    """|(x_p - x_q) - (ref_p - ref_q)| over the edges (p, q) of the nominal graph, tick by tick.

    Attributes:
        rms_m: (n_tick,) over the edges; NaN where none is left.
        max_m: (n_tick,) the same, of the largest.
        edges: (n_tick,) how many are left: an edge goes with the first of its vehicles to be lost or due to arrive.
    """

    rms_m: FloatArray
    max_m: FloatArray
    edges: npt.NDArray[np.int64]

    @property
    def overall_rms_m(self) -> float | None:
        """RMS over all edges and ticks; None without any."""
        if not self.edges.any():
            return None
        return math.sqrt(float(np.nansum(self.rms_m**2 * self.edges)) / int(self.edges.sum()))

    @property
    def overall_max_m(self) -> float | None:
        """The largest of all edges and ticks; None without any."""
        return float(np.nanmax(self.max_m)) if self.edges.any() else None


def formation_error(tracks: Tracks, edges: Sequence[Edge]) -> FormationError:
    """Compute the formation error over the edges, pairs of sysids."""
    row = {sysid: i for i, sysid in enumerate(tracks.sysids)}
    deviations = tracks.flown_m - tracks.planned_m
    squares = np.zeros(len(tracks.t_s))
    largest = np.full(len(tracks.t_s), np.nan)
    count = np.zeros(len(tracks.t_s), dtype=np.int64)
    for p, q in edges:
        square = np.sum((deviations[row[p]] - deviations[row[q]]) ** 2, axis=1)
        known = np.isfinite(square)
        squares[known] += square[known]
        count += known
        largest = np.fmax(largest, square)
    mean = np.divide(squares, count, out=np.full_like(squares, np.nan), where=count > 0)
    return FormationError(np.sqrt(mean), np.sqrt(largest), count)
