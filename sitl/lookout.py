"""A vehicle's lookout: tells the others where it will be, hears where they will, and has it give way."""

from collections.abc import Callable, Set

from sitl.avoidance.avoider import Heard
from sitl.avoidance.course import Situation
from sitl.avoidance.elsewhere import off_path
from sitl.avoidance.intent import GROUNDED, KEEPS, QUIET, YIELDS, Intent
from sitl.avoidance.yielding import Yielding
from sitl.config import VehicleConfig
from sitl.events import NOTICE, WARNING, StatusText
from sitl.formation.failures import within
from sitl.formation.swarm_clock import schedule_clock
from sitl.pilot import Phase, Pilot
from sitl.stages.path import PathStage
from sitl.ticks import TICK_S


class Lookout:
    """Looks out for a pilot. Where vehicles do not give way there is nothing to do, to tell or to hear.

    Args:
        pilot: who flies.
        config: of the vehicle.
        report: told when it begins to give way, and when that has ended.
    """

    def __init__(self, pilot: Pilot, config: VehicleConfig, report: Callable[[StatusText], None]) -> None:
        self._pilot = pilot
        self._avoider = pilot.avoider
        self._report = report
        self._frozen = config.network.frozen(config.sysid)

    def begin(self) -> None:
        """Begin a tick, before the pilot observes."""
        if self._avoider is None:
            return
        if (change := self._avoider.begin(self._pilot.tick, able=self._path is not None)) is not None:
            self._report(StatusText(NOTICE if change.distance_m is None else WARNING, str(change)))

    def intent(self) -> Intent:
        """What to tell the others of this tick, after the pilot has observed."""
        assert self._avoider is not None
        pilot = self._pilot
        if within(pilot.tick, self._frozen):
            return self._avoider.intent(pilot.tick, None, QUIET)
        if pilot.phase is not Phase.FLYING:
            return self._avoider.intent(pilot.tick, None, GROUNDED)
        if (now := self._situation()) is not None:
            return self._avoider.intent(pilot.tick, now, YIELDS if self._path is not None else KEEPS)
        return self._avoider.intent(pilot.tick, None, *off_path(pilot.flight, pilot.stage))

    def learn(self, heard: Heard, lost: Set[int]) -> None:
        """Take in what the others intend; decide from the next tick on. Between `observe` and `advance` of the pilot.

        Args:
            heard: by vehicle, what has come of it.
            lost: who is no more, beside those whom the schedule says so of.
        """
        assert self._avoider is not None
        now = self._situation() if self._path is not None else None
        self._avoider.learn(self._pilot.tick, now, heard, lost)

    def yieldings(self) -> tuple[Yielding, ...]:
        """Who was given way to so far."""
        return tuple(self._avoider.log) if self._avoider is not None else ()

    @property
    def _path(self) -> PathStage | None:
        """The path on which it can give way: not before a touchdown, and not frozen."""
        pilot, stage = self._pilot, self._pilot.stage
        if pilot.phase is not Phase.FLYING or within(pilot.tick, self._frozen):
            return None
        return stage if isinstance(stage, PathStage) and not stage.on_final else None

    def _situation(self) -> Situation | None:
        """Where it is on a path; None elsewhere, and where a station has changed the mode since it was observed."""
        pilot, stage, air = self._pilot, self._pilot.stage, self._pilot.flight.air
        if pilot.errors is None or not isinstance(stage, PathStage):
            return None
        return Situation(
            (air.x, air.y, air.h),
            pilot.errors,
            pilot.flight.point,
            air.V,
            pilot.airspeed_wanted_m_s,
            schedule_clock((pilot.tick - stage.started_tick) * TICK_S, pilot.shifts),
            stage.end_s_m,
            pilot.follows_schedule,
            stage.tables,
        )
