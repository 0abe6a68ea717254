"""Planned and flown positions of all vehicles on common ticks: what the figures of merit are computed from."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from gcs.metrics.swarm_time import SwarmTime
from gcs.truth import H, Truths, X
from missions.reference import Reference
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Tracks:
    """Positions from tick 0 to the last planned arrival, rows in order of sysid. Times are those of the swarm's clock,
    where there is one.

    Attributes:
        sysids: of the vehicles.
        t_s: (n_tick,).
        planned_m: (n_uav, n_tick, 3); NaN after the vehicle's own planned arrival.
        flown_m: (n_uav, n_tick, 3); NaN after the end of the vehicle's truth.
    """

    sysids: tuple[int, ...]
    t_s: FloatArray
    planned_m: FloatArray
    flown_m: FloatArray


def planned_tracks(references: Mapping[int, Reference]) -> Tracks:
    """The tracks of a plan that nobody has flown."""
    sysids = tuple(sorted(references))
    ticks = 1 + math.floor(max(reference.duration_s for reference in references.values()) / TICK_S)
    t_s = np.arange(ticks, dtype=np.float64) * TICK_S
    planned = np.full((len(sysids), ticks, 3), np.nan)
    for i, sysid in enumerate(sysids):
        own = t_s[t_s <= references[sysid].duration_s]
        planned[i, : len(own)] = references[sysid].positions(own)
    return Tracks(sysids, t_s, planned, np.full_like(planned, np.nan))


def flown_tracks(planned: Tracks, truths: Truths, time: SwarmTime | None = None) -> Tracks:
    """The tracks of a flight of a plan; a vehicle without truth was never seen.

    Args:
        time: by the swarm's clock; None where it had none.
    """
    flown = np.full_like(planned.planned_m, np.nan)
    for i, sysid in enumerate(planned.sysids):
        if sysid in truths:
            rows = truths[sysid][:, X : H + 1]
            if time is not None:
                rows = _at(time.flown_at(planned.t_s), rows)
            rows = rows[: len(planned.t_s)]
            flown[i, : len(rows)] = rows
    return replace(planned, flown_m=flown)


def _at(t_s: FloatArray, rows: FloatArray) -> FloatArray:
    """Rows (n_tick, k), one a tick, at other times (n,); NaN where there are none."""
    ticks = t_s / TICK_S
    return np.stack([np.interp(ticks, np.arange(len(rows)), column, right=np.nan) for column in rows.T], axis=1)


def tracks(references: Mapping[int, Reference], truths: Truths) -> Tracks:
    """Bring plan and truth to common ticks."""
    return flown_tracks(planned_tracks(references), truths)
