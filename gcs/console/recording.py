"""A flight that is over, shown from what was recorded of it."""

import math
from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np
import numpy.typing as npt

from gcs.console.logged_modes import Modes, mode_at
from gcs.console.moment import Course, Moment, Row, ShownLink
from gcs.flight_record import DISTURBANCE
from gcs.report_page.flown_run import FlownRun
from gcs.truth import CHI, GAMMA, H, V, X
from missions.airframe import GRAVITY_M_S2
from missions.reference import Reference
from sitl.modes import Mode
from sitl.ticks import TICK_S

FloatArray = npt.NDArray[np.float64]

POINTS = 600
"""Of a curve."""


class Recording:
    """A source that can be stopped, and gone about in.

    Args:
        run: that was flown.
        modes: by sysid, in which modes, where that was logged.

    Attributes:
        t_s: the moment that is shown.
        playing: whether it goes on by itself.
        speed: simulated seconds a second.
    """

    def __init__(self, run: FlownRun, modes: Mapping[int, Modes] | None = None) -> None:
        self.t_s = 0.0
        self.playing = True
        self.speed = 10.0
        self._run = run
        self._modes = modes or {}
        self._items = {uav.sysid: len(uav.mission) - 1 for uav in run.plan.uavs}
        self._frame_m = run.scenario.frame.alt_m
        changed_s = [event.t_s for event in run.metrics.events if event.what.startswith(DISTURBANCE)]
        self._delay_known_until_s = min(changed_s, default=math.inf)
        self._sysids = tuple(sorted(run.truths))
        self._vehicles = {vehicle.sysid: vehicle for vehicle in run.metrics.vehicles}

    @property
    def names(self) -> Mapping[int, str]:
        return {sysid: one.name for sysid, one in self._vehicles.items()}

    @cached_property
    def duration_s(self) -> float:
        """Of the flight, as far as anything of it was recorded."""
        return (max(map(len, self._run.truths.values())) - 1) * TICK_S

    def advance(self, passed_s: float) -> Moment:
        """The moment to show."""
        if self.playing:
            self.t_s = min(self.t_s + passed_s * self.speed, self.duration_s)
            self.playing = self.t_s < self.duration_s
        states = np.stack([self._state(sysid) for sysid in self._sysids])
        return Moment(self.t_s, self._sysids, states[:, :3], states[:, 3:])

    def trails(self, seconds: float, count: int) -> FloatArray:
        """Where they have been."""
        times = np.linspace(max(0.0, self.t_s - seconds), self.t_s, count)
        return np.stack([_rows_at(self._run.truths[sysid], times, slice(X, H + 1)) for sysid in self._sysids])

    def links(self) -> Sequence[ShownLink]:
        """The graph as it was used. In lockstep corrections are as old as they were delayed; in real time, on average.

        Who has arrived counts no more. From when they were disturbed on, nobody has recorded how old they were.
        """
        now = [used.edges for used in self._run.metrics.graph if used.t_s <= self.t_s]
        delay_s = self._delay_s if self.t_s < self._delay_known_until_s else None
        return [ShownLink(edge, delay_s) for edge in (now[-1] if now else ())]

    def rows(self) -> Sequence[Row]:
        """Of the table."""
        return [self._row(sysid) for sysid in sorted(self._vehicles)]

    def course(self) -> Course:
        """Over the whole flight."""
        return Course(**self._curves, now=int(np.searchsorted(self._curves["t_s"], self.t_s, side="right")))

    def state(self) -> str:
        """Of the clock."""
        return f"recorded, {self.speed:g} x" if self.playing else "recorded, paused"

    @property
    def _delay_s(self) -> float:
        metrics = self._run.metrics
        return metrics.formation.measured_delay_s or metrics.delay_s

    @cached_property
    def _curves(self) -> dict[str, FloatArray]:
        series = self._run.series
        ticks = np.unique(np.linspace(0, len(series.tracks.t_s) - 1, POINTS).astype(np.int64))
        return {
            "t_s": series.tracks.t_s[ticks],
            "error_m": series.error.rms_m[ticks],
            "separation_m": series.separation_m[ticks],
            "delay_s": np.where(
                (series.error.edges[ticks] > 0) & (series.tracks.t_s[ticks] < self._delay_known_until_s),
                self._delay_s,
                np.nan,
            ),
        }

    def _state(self, sysid: int) -> FloatArray:
        """x, y, h, roll, pitch and heading, (6,)."""
        truth = self._run.truths[sysid]
        position = _rows_at(truth, np.array([self.t_s]), slice(X, H + 1))[0]
        tick = min(round(self.t_s / TICK_S), len(truth) - 1)
        before, after = truth[max(tick - 1, 0)], truth[min(tick + 1, len(truth) - 1)]
        speed, gamma, chi = truth[tick, [V, GAMMA, CHI]]
        turn = (after[CHI] - before[CHI] + math.pi) % (2.0 * math.pi) - math.pi
        # (24) of the paper, solved for the bank of a level turn; heading is anticlockwise, so a right turn is negative.
        roll = -math.atan(speed * turn / (2.0 * TICK_S) / GRAVITY_M_S2)
        return np.array([*position, roll, gamma, chi])

    def _row(self, sysid: int) -> Row:
        vehicle, truth = self._vehicles[sysid], self._run.truths.get(sysid)
        if truth is None or (vehicle.lost_s is not None and self.t_s >= vehicle.lost_s):
            return Row(sysid, vehicle.name, "lost", well=False)
        tick = min(round(self.t_s / TICK_S), len(truth) - 1)
        reference = self._run.series.references[sysid]
        arrived = vehicle.arrival_s is not None and self.t_s >= vehicle.arrival_s
        mode = mode_at(self._modes.get(sysid, []), self.t_s) or Mode.AUTO.name
        on_plan = mode == Mode.AUTO.name and not arrived
        passed = int(np.searchsorted(reference.corner_time_s, self.t_s, side="right"))
        last = len(reference.corner_seq) - 1
        return Row(
            sysid=sysid,
            name=vehicle.name,
            mode="arrived" if arrived and mode == Mode.AUTO.name else mode,
            item=(self._items[sysid] if passed > last else reference.corner_seq[passed], self._items[sysid]),
            speed_m_s=float(truth[tick, V]),
            altitude_m=float(truth[tick, H]) + self._frame_m,
            error_m=_ahead_m(truth[tick, X : H + 1], reference, self.t_s) if on_plan else None,
            link=f"{self._delay_s:.2f} s" if on_plan and self.t_s < self._delay_known_until_s else "",
        )


def _rows_at(truth: FloatArray, times: FloatArray, columns: slice) -> FloatArray:
    """Columns (k, n) of rows at times (k,), between ticks on the straight line; NaN after the last."""
    ticks = times / TICK_S
    whole = np.clip(ticks.astype(np.int64), 0, len(truth) - 1)
    share = (ticks - whole)[:, None]
    found = (1.0 - share) * truth[whole, columns] + share * truth[np.minimum(whole + 1, len(truth) - 1), columns]
    found[ticks > len(truth) - 1] = np.nan
    return found


def _ahead_m(position_m: FloatArray, reference: Reference, t_s: float) -> float:
    """How far a position is ahead of the planned one, along the track."""
    times = np.clip([t_s - 0.5, t_s, t_s + 0.5], 0.0, reference.duration_s)
    before, planned, after = reference.positions(times)
    along = (after - before)[:2]
    return float((position_m - planned)[:2] @ along / max(float(np.hypot(*along)), 1e-9))
