"""Who flies one vehicle, tick by tick: wind, its stage, the formation law, touchdown, the roll to a stop."""

import math
from collections import deque
from collections.abc import Callable, Mapping
from enum import Enum, auto

from missions.environment.terrain import ground_height_m
from missions.reference.reference import Speed
from sitl.aircraft.gusts import NORMALS_PER_TICK
from sitl.avoidance.avoider import Avoider
from sitl.config import VehicleConfig
from sitl.flight import (
    LAUNCH_SLOPE,
    Vector,
    at_point,
    ground_velocity,
    in_next_wind,
    launched,
    launched_along,
    make_aircraft,
    moved,
    parked,
    path_accelerations,
)
from sitl.formation.correction import Correction
from sitl.formation.failures import within
from sitl.formation.formation import Formation
from sitl.formation.law import formation_acceleration
from sitl.formation.swarm_clock import UNSHIFTED, Shifts, grown, own_needs, schedule_clock
from sitl.guidance.path_errors import START, PathErrors, PathPoint, path_errors
from sitl.guidance.path_law import (
    PLANNED_ROOM_M_S,
    SPEED_ROOM_M_S,
    Accelerations,
    clamp,
    speed_acceleration,
    speed_before_height,
)
from sitl.itinerary import Stage as MissionStage
from sitl.itinerary import Start
from sitl.landing import flared, rolled, touched_down, with_flaps
from sitl.noise import Stream, normals
from sitl.stages.circle import CircleStage
from sitl.stages.path import PathStage
from sitl.stages.straight import ClimbOutStage, GlideStage
from sitl.ticks import TICK_S

Stage = MissionStage | GlideStage


class Phase(Enum):
    """Where it is: on the launcher or where it has stopped, in the air, or on its wheels."""

    PARKED = auto()
    FLYING = auto()
    ROLLING = auto()


class Pilot:
    """Flies stages.

    Args:
        config: of the vehicle.
        home_m: where it stands.
        airspeed_limits: the least and the greatest airspeed that are set, and the one to cruise at.

    Attributes:
        tick: simulated time.
        flight, phase: the state of the aircraft.
        stage: what it flies.
        errors: its deviations from the path of that, as of this tick.
        in_formation: it keeps its schedule, and neighbours' corrections count.
        formation: what it hears of its neighbours.
        shifts: of its schedule.
        avoider: how it gives way; None where vehicles do not.
        commanded: a speed that goes before the stage's.
        reached: mission items, until they are taken out.
    """

    def __init__(
        self, config: VehicleConfig, home_m: Vector, airspeed_limits: Callable[[], tuple[float, float, float]]
    ) -> None:
        self.flight = parked(home_m, 0.0)
        self.tick = 0
        self.phase = Phase.PARKED
        self.stage: Stage | None = None
        self.errors: PathErrors | None = None
        self.commanded: Speed | None = None
        self.in_formation = False
        self.shifts = UNSHIFTED
        self.reached: list[int] = []
        self._config = config
        self._airspeed_limits = airspeed_limits
        self._aircraft = make_aircraft(config.airframe, config.terrain, config.gusts, config.steady_wind_m_s)
        self._flapped = self._aircraft._replace(airframe=with_flaps(config.airframe))
        self._powerless = self._aircraft._replace(airframe=config.airframe._replace(static_thrust_n=0.0))
        self._normals = normals(config.seed, config.sysid, Stream.GUSTS, NORMALS_PER_TICK)
        self._gains = config.gains if config.arm == "full" else config.gains._replace(k1=0.0, k2=0.0)
        self.formation = Formation(
            config.sysid, config.network, config.seed, real_time=config.real_time, clocked=config.swarm_clock
        )
        self._frozen = config.network.frozen(config.sysid)
        self.avoider = Avoider(config) if config.avoid_m is not None else None
        self._own: deque[Correction] = deque(maxlen=self.formation.remembers_ticks)
        self._corrections = 0.0

    @property
    def airborne(self) -> bool:
        """Whether it is in the air."""
        return self.phase is Phase.FLYING

    @property
    def start(self) -> Start:
        """Where its next stage would begin."""
        air = self.flight.air
        east, north, _ = ground_velocity(self.flight)
        return Start((air.x, air.y, air.h), math.atan2(north, east) if self.airborne else None)

    @property
    def airspeed_wanted_m_s(self) -> float:
        """What it is to fly at now."""
        slow, fast, cruise = self._airspeed_limits()
        if self.commanded is not None:
            east, north, _ = ground_velocity(self.flight)
            surplus = self.flight.air.V - math.hypot(east, north) if self.commanded.over_ground else 0.0
            return clamp(self.commanded.m_s + surplus, slow, fast)
        stage = self.stage
        if isinstance(stage, PathStage):
            return stage.airspeed_m_s(self.flight.point.s_m)
        if isinstance(stage, GlideStage):
            return stage.airspeed_m_s
        if isinstance(stage, CircleStage) and stage.airspeed_m_s is not None:
            return stage.airspeed_m_s
        return clamp(cruise, slow, fast)

    def fly(self, stage: Stage) -> None:
        """Begin a stage, in the air or for the launch to come."""
        self.stage = stage
        self.errors, self.in_formation, self.shifts = None, False, UNSHIFTED
        if isinstance(stage, PathStage):
            stage.started_tick = self.tick
            self.flight = at_point(self.flight, START)

    def change_path(self, stage: PathStage) -> None:
        """Go on along another path, which up to here is the same as that of the stage there is."""
        self.stage = stage
        self.flight = at_point(self.flight, PathPoint(self.flight.point.s_m, 0, 0, 0))

    def resume_schedule(self) -> None:
        """Let the schedule of the path begin where the aircraft is on it."""
        if isinstance(self.stage, PathStage):
            since_s = self.stage.time_at_s(self.flight.point.s_m) + self.shifts.slowed.sum_s - self.shifts.hurried.sum_s
            self.stage.started_tick = self.tick - round(since_s / TICK_S)

    def launch(self) -> None:
        """Off the launcher, into the stage there is."""
        stage, air = self.stage, self.flight.air
        here = (air.x, air.y, air.h)
        self.phase = Phase.FLYING
        if isinstance(stage, PathStage):
            self.flight = launched(here, stage.tables, next(self._normals), self._aircraft)
            stage.started_tick = self.tick
            return
        assert isinstance(stage, ClimbOutStage)
        wind_x, wind_y = self._config.forecast_wind_m_s
        tail = wind_x * math.cos(stage.course) + wind_y * math.sin(stage.course)
        speed = max(self.airspeed_wanted_m_s + tail, self._config.airframe.airspeed_min_m_s)
        self.flight = launched_along(here, stage.course, LAUNCH_SLOPE, speed, next(self._normals), self._aircraft)

    def feel(self) -> None:
        """The wind of this tick."""
        self.flight = in_next_wind(self.flight, next(self._normals), self._aircraft)

    def observe(self) -> Correction:
        """Find the deviations from the path and schedule; returns the own one, for the neighbours."""
        stage = self.stage
        self.errors, self.in_formation = None, False
        along = along_rate = 0.0
        if isinstance(stage, PathStage) and self.phase is Phase.FLYING:
            self.errors = errors = self._errors_on(stage)
            scheduled = self.commanded is None and not stage.on_final and not within(self.tick, self._frozen)
            if scheduled and (self.avoider is None or not self.avoider.yields):
                self.in_formation = True
                along, along_rate = errors.along, errors.along_rate
        own = Correction(self._config.sysid, self.tick, self.tick, self.in_formation, along, along_rate)
        if self._config.swarm_clock:
            slowed, hurried = self.shifts
            own = own._replace(
                slowed_s=slowed.sum_s, slowed_rate=slowed.rate, hurried_s=hurried.sum_s, hurried_rate=hurried.rate
            )
        self._own.append(own)
        return own

    def _errors_on(self, stage: PathStage) -> PathErrors:
        """The deviations from a path and its schedule at this tick, and the place on it kept in mind."""
        flight = self.flight
        air, velocity = flight.air, ground_velocity(flight)
        clock = schedule_clock((self.tick - stage.started_tick) * TICK_S, self.shifts)
        errors, point = path_errors((air.x, air.y, air.h), velocity, clock, flight.point, stage.tables)
        self.flight = at_point(flight, point)
        return errors

    def hear(self, heard: Mapping[int, Correction]) -> None:
        """Take in what the neighbours say; see `Formation.corrections`. Once a tick, after `observe`."""
        self._corrections = self.formation.corrections(self.tick, self._own, heard, self._gains)

    def advance(self) -> None:
        """Decide and move; what is reached is in `reached` then."""
        if self.phase is Phase.ROLLING:
            self.flight = rolled(self.flight, self._aircraft.terrain)
            if self.flight.air.V == 0.0:
                self.phase, self.stage = Phase.PARKED, None
            return
        stage, errors, aircraft = self.stage, self.errors, self._aircraft
        if isinstance(stage, PathStage):
            if errors is None:  # a station has changed the mode since `observe`
                errors = self._errors_on(stage)
            ahead = self._ahead(errors)
            if self._config.swarm_clock:
                self._shift_schedule(errors)
            if self.avoider is not None:
                errors = self.avoider.aside(errors)
            wanted = path_accelerations(errors, ahead, self.flight.air.V, aircraft.airframe)
            if stage.on_final:
                aircraft = self._flapped
                wanted = flared(wanted, self.flight, self._ground_m(), aircraft.airframe)
            self.flight = flight = moved(self.flight, wanted, aircraft)
            if reached := stage.passed(flight.point.s_m, flight.air.h):
                self.reached += reached
            if stage.on_final:
                self._touch_down()
        elif isinstance(stage, GlideStage):
            wanted = flared(stage.accelerations(self.flight), self.flight, self._ground_m(), aircraft.airframe)
            self.flight = moved(self.flight, wanted, self._powerless)
            self._touch_down()
        elif stage is not None:
            wanted = self._straight_or_round(stage)
            planned = isinstance(stage, CircleStage) and stage.guard is None
            room_m_s = PLANNED_ROOM_M_S if planned else SPEED_ROOM_M_S
            wanted = speed_before_height(wanted, self.flight.air.V, room_m_s, aircraft.airframe)
            self.flight = moved(self.flight, wanted, aircraft)
            stage.note(self.flight)

    def _straight_or_round(self, stage: CircleStage | ClimbOutStage) -> Accelerations:
        if isinstance(stage, CircleStage):
            return stage.accelerations(self.flight, self.airspeed_wanted_m_s, self.tick)
        return stage.accelerations(self.flight, self.airspeed_wanted_m_s)

    @property
    def follows_schedule(self) -> bool:
        """On its path it is where its schedule wants it, and does not just hold an airspeed."""
        return self._config.arm != "plain" and self.commanded is None

    def _ahead(self, errors: PathErrors) -> float:
        """u_t: a plain autopilot's, or the law's, or that of one who gives way."""
        if self.avoider is not None and self.avoider.yields:
            follows, airspeed = self.follows_schedule, self.flight.air.V
            return self.avoider.acceleration(errors, self.airspeed_wanted_m_s, airspeed, follows=follows)
        if self._config.arm == "plain" or not self.in_formation:
            return speed_acceleration(self.airspeed_wanted_m_s, self.flight.air.V)
        return formation_acceleration(errors, self._corrections, self._gains)

    def _shift_schedule(self, errors: PathErrors) -> None:
        """Slow or hurry the schedule as far as the own speed's limits, or the neighbours, would have it."""
        slow = hurry = 0.0
        if self.in_formation:
            slow, hurry = own_needs(errors.along, self.flight.air, self.flight.controls, self._aircraft.airframe)
            slow, hurry = max(slow, self.formation.needs[0]), max(hurry, self.formation.needs[1])
        self.shifts = Shifts(grown(self.shifts.slowed, slow), grown(self.shifts.hurried, hurry))

    def _touch_down(self) -> None:
        ground_m = self._ground_m()
        if self.flight.air.h <= ground_m:
            self.flight = touched_down(self.flight, ground_m)
            self.phase, self.errors, self.in_formation = Phase.ROLLING, None, False

    def _ground_m(self) -> float:
        return ground_height_m(self.flight.air.x, self.flight.air.y, self._aircraft.terrain)
