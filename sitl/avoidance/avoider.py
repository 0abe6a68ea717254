"""One vehicle's part in the avoidance of collisions: what it has been told, what it tells, what it does."""

from collections.abc import Iterable, Mapping, Set

from sitl.avoidance.course import Situation, predict
from sitl.avoidance.intent import GROUNDED, POINTS, QUIET, Intent, Point, intent_at
from sitl.avoidance.intent_link import IntentLink, channel_of_intents
from sitl.avoidance.manoeuvre import (
    AS_PLANNED,
    FREE,
    aside,
    going_on,
    pace_alone,
    pace_of,
    yielding_acceleration,
)
from sitl.avoidance.rule import NEVER, Known, decide
from sitl.avoidance.yielding import Yielding
from sitl.config import VehicleConfig
from sitl.formation.channel import DRAWS
from sitl.guidance.path_errors import PathErrors
from sitl.noise import Stream, uniforms

Heard = Mapping[int, Iterable[tuple[Intent, int]]]
"""By sysid, the intents that have come since the last time, and the whole ticks that each took."""


class Avoider:
    """Keeps one vehicle out of the others' way.

    Args:
        config: of the vehicle; `avoid_m` is the safe distance.

    Attributes:
        manoeuvre: of this tick.
        log: who was given way to.
    """

    def __init__(self, config: VehicleConfig) -> None:
        assert config.avoid_m is not None
        self.manoeuvre = AS_PLANNED
        self.log: list[Yielding] = []
        self._sysid = config.sysid
        self._network = network = config.network
        self._separation_m = config.avoid_m
        self._airframe = config.airframe
        self._row = network.sysids.index(config.sysid)
        self._links = {other: self._link(other, config.seed) for other in network.sysids if other != config.sysid}
        count = len(network.sysids)
        self._known = Known([NEVER] * count, [QUIET] * count, [1.0] * count, [0] * count, [()] * count)
        self._points = [[0.0, 0.0, 0.0] for _ in range(POINTS)]
        self._next = AS_PLANNED
        self._foreseen = 0.0, 0.0

    @property
    def yields(self) -> bool:
        """It gives way, and does not count in the formation."""
        return self.manoeuvre.action != FREE

    def begin(self, tick: int, *, able: bool) -> Yielding | None:
        """Begin a tick; returns whom it gives way to, or no more, if that has changed.

        Args:
            able: to give way; who is not, off its path or frozen, flies as planned.
        """
        was = self.manoeuvre
        self.manoeuvre = going_on(self._next, self._separation_m) if able else AS_PLANNED
        self._next = self.manoeuvre
        if self.manoeuvre.other == was.other:
            return None
        if was.other >= 0:
            self.log.append(Yielding(tick, self._network.sysids[was.other]))
        else:
            self.log.append(Yielding(tick, self._network.sysids[self.manoeuvre.other], *self._foreseen))
        return self.log[-1]

    def intent(self, tick: int, now: Situation | None, status: int, points: tuple[Point, ...] = ()) -> Intent:
        """What to tell at a tick.

        Args:
            now: on its path; None elsewhere, where `points` is where it will be.
        """
        if now is not None:
            count = predict(pace_of(now, self.manoeuvre, self._separation_m), now, POINTS, self._points)
            points = tuple((x, y, z) for x, y, z in self._points[:count])
            return intent_at(self._sysid, tick, status, points, pace_alone(now, self.manoeuvre))
        return intent_at(self._sysid, tick, status, points)

    def learn(self, tick: int, now: Situation | None, heard: Heard, lost: Set[int]) -> None:
        """Take in what the others have told, and decide what to do from the next tick on.

        Args:
            now: None for one that is not able to give way.
            lost: who is no more, beside those whom the schedule says so of.
        """
        known = self._known
        gone = lost | self._network.gone_at(tick)
        for row, other in enumerate(self._network.sysids):
            if other == self._sysid:
                continue
            link = self._links[other]
            for intent, took_ticks in heard.get(other, ()):
                link.arrive(intent, took_ticks)
            if (told := link.newer(tick)) is not None:
                known.stamp[row], known.status[row], known.alone[row] = told.tick, told.status, told.alone
                known.places[row], known.points[row] = len(told.points), told.points
            if other in gone:
                known.status[row] = GROUNDED
        if now is not None:
            verdict = decide(
                self._row, tick, now, self.manoeuvre, known, self._separation_m, self._airframe, self._points
            )
            self._next, self._foreseen = verdict.manoeuvre, (verdict.distance_m, verdict.in_s)

    def aside(self, errors: PathErrors) -> PathErrors:
        """The deviations from the path as it is to be flown now."""
        return aside(errors, self.manoeuvre) if self.manoeuvre.raised_m > 0.0 else errors

    def acceleration(self, errors: PathErrors, airspeed_wanted: float, airspeed: float, *, follows: bool) -> float:
        """u_t of one who gives way."""
        return yielding_acceleration(errors, self.manoeuvre, airspeed_wanted, airspeed, follows)

    def _link(self, sender: int, seed: int) -> IntentLink:
        channel = channel_of_intents(self._network.channel_of(sender, self._sysid))
        draws = None if channel.certain else uniforms(seed, sender, self._sysid, DRAWS, Stream.INTENTS)
        return IntentLink(channel, draws, self._network.silences(sender, self._sysid))
