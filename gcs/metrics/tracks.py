"""Planned and flown positions of all vehicles on common ticks: what the figures of merit are computed from."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from gcs.truth import H, Truths, X
from missions.reference import Reference
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Tracks:
    """Positions from tick 0 to the last planned arrival, rows in order of sysid.

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


def flown_tracks(planned: Tracks, truths: Truths) -> Tracks:
    """The tracks of a flight of a plan; a vehicle without truth was never seen."""
    flown = np.full_like(planned.planned_m, np.nan)
    for i, sysid in enumerate(planned.sysids):
        if sysid in truths:
            rows = truths[sysid][: len(planned.t_s), X : H + 1]
            flown[i, : len(rows)] = rows
    return replace(planned, flown_m=flown)


def tracks(references: Mapping[int, Reference], truths: Truths) -> Tracks:
    """Bring plan and truth to common ticks."""
    return flown_tracks(planned_tracks(references), truths)
