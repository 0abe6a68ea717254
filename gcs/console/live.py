"""Vehicles that fly, shown from what they tell: those of a simulation, or any."""

import contextlib
import math
from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
import numpy.typing as npt
from scipy.spatial import KDTree

from gcs.console.moment import Course, Moment, Row, ShownLink
from gcs.console.shown_time import ShownTime
from gcs.console.telemetry import Telemetry
from gcs.fleet import Fleet
from gcs.flight_modes import mode_name
from gcs.operations import is_armed
from gcs.vehicle_link import SILENCE_S, VehicleLink
from missions.frame import LocalFrame
from missions.reference import Reference
from sitl.formation.graph import Edge
from sitl.services.peer import Message

FloatArray = npt.NDArray[np.float64]

REMEMBERED = 3000
"""Points of a curve; every second one goes when there are more."""
VALID_MS = 5000
"""Of a value that is told each second, in the vehicle's time."""
NO_TOTAL = 0xFFFF
"""Of MISSION_CURRENT: there is no mission."""


class Live:
    """A source that is fed by a fleet.

    Args:
        fleet: of the vehicles.
        frame: of positions.
        names: by sysid, of those that are known to have one.
        references: what they are to fly, by sysid; empty when nobody knows.
        edges: of the formation.
        simulated: they go by one clock.
        stack: that ends the listening.

    Attributes:
        ages_s: of the corrections over each link (sender, receiver), where the swarm tells; kept up to date by others.
        lost: why vehicles were lost, by sysid; kept up to date by others.
        doing: what is shown, for people.
    """

    def __init__(
        self,
        fleet: Fleet,
        frame: LocalFrame,
        names: Mapping[int, str],
        references: Mapping[int, Reference],
        edges: Sequence[Edge],
        *,
        simulated: bool,
        stack: contextlib.ExitStack,
    ) -> None:
        self.ages_s: dict[tuple[int, int], float | None] | None = None
        self.lost: dict[int, str] = {}
        self.doing = "live"
        self._fleet = fleet
        self._stack = stack
        self._values: dict[tuple[int, str], tuple[int, float]] = {}
        self._names = dict(names)
        self._references = references
        self._edges = tuple(edges)
        self._telemetry = Telemetry(frame, simulated=simulated)
        self._time = ShownTime()
        self._moment = Moment(0.0, (), np.empty((0, 3)), np.empty((0, 3)))
        self._curve: list[tuple[float, float, float, float]] = []

    @property
    def names(self) -> Mapping[int, str]:
        return {sysid: self._names.get(sysid, "") for sysid in self._fleet.vehicles}

    def advance(self, passed_s: float) -> Moment:
        """The moment to show."""
        self._telemetry.follow(self._fleet.vehicles, self._listen)
        tracks = {i: track for i, track in sorted(self._telemetry.tracks.items()) if math.isfinite(track.newest_s)}
        heard = [track for i, track in tracks.items() if self._is_heard(i)]
        newest_s = min((track.newest_s for track in heard), default=self._time.t_s)
        t_s = self._time.advance(passed_s, newest_s, max((track.step_s for track in heard), default=0.0))
        states = [track.at(t_s) for track in tracks.values()]
        self._moment = Moment(
            t_s,
            tuple(tracks),
            np.array([position for position, _ in states]).reshape(-1, 3),
            np.array([attitude for _, attitude in states]).reshape(-1, 3),
            frozenset(self.lost),
        )
        return self._moment

    def trails(self, seconds: float, count: int) -> FloatArray:
        """Where they have been."""
        times = np.linspace(self._moment.t_s - seconds, self._moment.t_s, count)
        trails = [self._telemetry.tracks[sysid].trail(times) for sysid in self._moment.sysids]
        return np.array(trails).reshape(-1, count, 3)

    def links(self) -> Sequence[ShownLink]:
        """Of the formation, as old as the swarm tells; where it does not, as the older of both vehicles' last words."""
        there = [edge for edge in self._pairs() if not self.lost.keys() & set(edge)]
        return [ShownLink(edge, self._age_s(edge)) for edge in there]

    def rows(self) -> Sequence[Row]:
        """Of the table."""
        return [self._row(sysid, vehicle) for sysid, vehicle in sorted(self._fleet.vehicles.items())]

    def course(self) -> Course:
        """Of the figures of merit so far; called at each step, it goes on by one."""
        moment = self._moment
        if not self._curve or moment.t_s > self._curve[-1][0]:
            self._curve.append((moment.t_s, self._error_m(), self._separation_m(), self._delay_s()))
            if len(self._curve) > REMEMBERED:
                self._curve = self._curve[::2]
        t_s, error_m, separation_m, delay_s = np.array(self._curve).T
        return Course(t_s, error_m, separation_m, delay_s, now=len(t_s))

    def state(self) -> str:
        """How fast it goes."""
        return f"{self.doing}, {self._time.rate:.1f} x" if self._time.rate >= 0.05 else f"{self.doing}, held"

    def _listen(self, vehicle: VehicleLink) -> None:
        self._stack.enter_context(vehicle.listening(partial(self._on_message, vehicle)))

    def _on_message(self, vehicle: VehicleLink, message: Message) -> None:
        if message.get_type() == "NAMED_VALUE_FLOAT":
            self._values[vehicle.sysid, str(message.name)] = (vehicle.simulated_ms, message.value)
        else:
            self._telemetry.on_message(vehicle.sysid, vehicle, message)

    def _is_heard(self, sysid: int) -> bool:
        return sysid not in self.lost and self._fleet.vehicles[sysid].heard

    def _pairs(self) -> Sequence[Edge]:
        """The links that count now: those that the swarm names, or those of the graph."""
        if self.ages_s is None:
            return self._edges
        return sorted({(min(pair), max(pair)) for pair in self.ages_s})

    def _age_s(self, edge: Edge) -> float | None:
        if self.ages_s is None:
            return max(self._fleet.vehicles[sysid].silent_s if sysid in self._fleet.vehicles else 0.0 for sysid in edge)
        ages = [self.ages_s.get(pair) for pair in (edge, edge[::-1])]
        known = [age for age in ages if age is not None]
        return max(known) if len(known) == len(ages) else None

    def _planned_m(self) -> FloatArray:
        """Where the vehicles of the moment should be, (n, 3); NaN for those whose plan is over, or is not known."""
        planned = np.full((len(self._moment.sysids), 3), np.nan)
        for i, sysid in enumerate(self._moment.sysids):
            reference, t_s = self._references.get(sysid), self._moment.t_s + self._shift_s(sysid)
            if reference is not None and t_s <= reference.duration_s:
                planned[i] = reference.positions(np.array([max(t_s, 0.0)]))[0]
        return planned

    def _error_m(self) -> float:
        """RMS over the edges."""
        row = {sysid: i for i, sysid in enumerate(self._moment.sysids)}
        deviations = self._moment.position_m - self._planned_m()
        pairs = [(row[p], row[q]) for p, q in self._pairs() if p in row and q in row]
        squares = [float(np.sum((deviations[p] - deviations[q]) ** 2)) for p, q in pairs]
        known = [square for square in squares if math.isfinite(square)]
        return math.sqrt(sum(known) / len(known)) if known else math.nan

    def _separation_m(self) -> float:
        there = [i for i, sysid in enumerate(self._moment.sysids) if self._is_heard(sysid)]
        if len(there) < 2:
            return math.nan
        places = self._moment.position_m[there]
        distances, _ = KDTree(places).query(places, k=2)  # the first is its own
        return float(np.asarray(distances)[:, 1].min())

    def _delay_s(self) -> float:
        known = [age for age in (self.ages_s or {}).values() if age is not None]
        return sum(known) / len(known) if known else math.nan

    def _shift_s(self, sysid: int) -> float:
        """By how much the swarm's clock is ahead of the time since the launch."""
        return self._values.get((sysid, "FormShift"), (0, 0.0))[1]

    def _value(self, vehicle: VehicleLink, name: str) -> float | None:
        """What a vehicle has said of itself lately: out of the formation it says no more."""
        said_ms, value = self._values.get((vehicle.sysid, name), (0, math.nan))
        fresh = vehicle.simulated_ms - said_ms < VALID_MS
        return value if fresh and math.isfinite(value) else None

    def _row(self, sysid: int, vehicle: VehicleLink) -> Row:
        name = self._names.get(sysid, "")
        if sysid in self.lost:
            return Row(sysid, name, "lost", well=False)
        hud = vehicle.latest.get("VFR_HUD")
        current, navigation = vehicle.latest.get("MISSION_CURRENT"), vehicle.latest.get("NAV_CONTROLLER_OUTPUT")
        error_m = self._value(vehicle, "FormErr")
        if error_m is None and navigation is not None:
            error_m = navigation.xtrack_error
        silent = vehicle.silent_s > SILENCE_S
        return Row(
            sysid=sysid,
            name=name,
            mode=_mode(vehicle),
            item=None if current is None else (current.seq, current.total if 0 < current.total < NO_TOTAL else None),
            speed_m_s=None if hud is None else hud.airspeed,
            altitude_m=None if hud is None else hud.alt,
            error_m=error_m,
            link=f"silent {vehicle.silent_s:.0f} s" if silent else self._age_text(sysid),
            well=not silent,
        )

    def _age_text(self, sysid: int) -> str:
        ages = [age for (_, receiver), age in (self.ages_s or {}).items() if receiver == sysid]
        known = [age for age in ages if age is not None]
        return f"{max(known):.2f} s" if known else ""


def _mode(vehicle: VehicleLink) -> str:
    """What a vehicle does, as its heartbeat has it."""
    if "HEARTBEAT" not in vehicle.latest:
        return ""
    mode = mode_name(vehicle.latest["HEARTBEAT"].custom_mode, vehicle.autopilot)
    return mode if is_armed(vehicle) else f"{mode}, disarmed"
