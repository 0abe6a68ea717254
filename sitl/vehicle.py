"""One simulated vehicle: its flight, tick by tick, and what a pilot may ask of it."""

import threading
from collections import deque
from collections.abc import Mapping, Sequence

from missions.airframe import thrust_max_n
from missions.commands import NAVIGATION, Command, Frame
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.reference.reference import fillet_radius_m
from sitl.aircraft.gusts import NORMALS_PER_TICK
from sitl.config import VehicleConfig
from sitl.events import ItemReached, StatusText
from sitl.flight import (
    airspeed_at,
    at_point,
    ground_velocity,
    in_next_wind,
    launched,
    make_aircraft,
    moved,
    parked,
    path_accelerations,
)
from sitl.formation.correction import Correction
from sitl.formation.law import correction, formation_acceleration
from sitl.guidance.loiter_law import Loiter, loiter_accelerations
from sitl.guidance.path_errors import START, PathErrors, path_errors
from sitl.guidance.path_law import Accelerations, speed_acceleration
from sitl.mission_progress import MissionProgress
from sitl.modes import Mode
from sitl.noise import Stream, normals
from sitl.parameters import Parameters, arduplane_parameters
from sitl.snapshot import LandedState, Snapshot
from sitl.store import Store
from sitl.ticks import TICK_S
from sitl.truth import TruthWriter

SEVERITY_INFO = 6
"""MAV_SEVERITY_INFO."""


class Vehicle:
    """A simulated vehicle.

    The clock's thread calls `observe` and `advance` in turn, once a tick each; any thread may ask the rest while it
    holds `lock`.

    Args:
        config: what it is told at its start.
        truth: takes its state at each tick.
        store: keeps plans and parameters over restarts.
    """

    def __init__(self, config: VehicleConfig, truth: TruthWriter, store: Store | None = None) -> None:
        self.lock = threading.RLock()
        self.tick = 0
        self.mode = Mode.MANUAL
        self.armed = False
        lat_e7, lon_e7 = config.frame.to_e7(config.home_m[0], config.home_m[1])
        altitude_m = config.home_m[2] + config.frame.alt_m
        self.home = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=altitude_m)
        self.mission = Mission((self.home,))
        self.parameters = Parameters(arduplane_parameters(config.sysid, config.airframe), store or Store())
        self._plans: dict[PlanType, tuple[MissionItem, ...]] = {PlanType.FENCE: (), PlanType.RALLY: ()}

        self._config = config
        self._truth = truth
        self._aircraft = make_aircraft(config.airframe, config.terrain, config.gusts, config.steady_wind_m_s)
        self._normals = normals(config.seed, config.sysid, Stream.GUSTS, NORMALS_PER_TICK)
        self._gains = config.gains if config.arm == "full" else config.gains._replace(k1=0.0, k2=0.0)
        x, y = config.frame.from_e7(lat_e7, lon_e7)
        self._home_m = (x, y, self.home.alt_m - config.frame.alt_m)
        self._flight = parked(self._home_m, 0.0)
        self._progress: MissionProgress | None = None
        self._loiter: Loiter | None = None
        self._errors: PathErrors | None = None
        self._schedule_start_tick: int | None = None
        self._own: deque[Correction] = deque(maxlen=config.delay_ticks + 1)
        self._events: list[ItemReached | StatusText] = []

    # What a pilot may ask.

    @property
    def sysid(self) -> int:
        """MAVLink system id; to its neighbours it stays what it was configured as."""
        return int(self.parameters["MAV_SYSID"])

    @property
    def airborne(self) -> bool:
        """Whether it has been launched."""
        return self._schedule_start_tick is not None

    def load_mission(self, mission: Mission) -> None:
        """Take a mission; the old one stays if the new one cannot be flown. One without waypoints holds nothing to fly.

        Raises:
            InputError: it cannot be flown; the message says why.
        """
        progress = None
        if any(item.command in NAVIGATION for item in mission.items[1:]):
            config = self._config
            progress = MissionProgress(mission, config.frame, config.airframe, config.forecast_wind_m_s)
        self.mission = mission
        self._progress = progress
        self._errors = None
        self._flight = at_point(self._flight, START)

    def items(self, plan: PlanType) -> tuple[MissionItem, ...]:
        """The plan held of one type; a mission has at least home."""
        return self.mission.items if plan == PlanType.MISSION else self._plans[plan]

    def load(self, plan: PlanType, items: Sequence[MissionItem]) -> None:
        """Take over a plan of one type. Raises InputError when it cannot be flown."""
        if plan == PlanType.MISSION:
            self.load_mission(Mission(tuple(items)))
        else:
            self._plans[plan] = tuple(items)

    def set_current(self, seq: int) -> str | None:
        """Go on with this item of the mission."""
        return "not yet"

    def change_speed(self, speed_m_s: float, *, over_ground: bool) -> str | None:
        """Fly at another speed from now on."""
        return "not yet"

    def take_off(self, altitude_m: float) -> str | None:
        """Take off in mode TAKEOFF."""
        return "not yet"

    def reposition(self, item: MissionItem) -> str | None:
        """Fly to a place in mode GUIDED and circle there."""
        return "not yet"

    def set_home(self, home: MissionItem | None) -> str | None:
        """Change home."""
        return "not yet"

    def enable_fence(self, enabled: bool) -> str | None:
        """Heed the fence, or not."""
        return "not yet"

    def hear_station(self, now_s: float) -> None:
        """The station has been heard."""

    def watch_station(self, now_s: float) -> None:
        """Wall time has passed."""

    def prearm(self) -> str | None:
        """Why it could not be armed now."""
        return None

    def arm(self, *, force: bool = False) -> str | None:
        """Arm; returns the reason when it cannot be done."""
        self.armed = True
        return None

    def disarm(self, *, force: bool = False) -> str | None:
        """Disarm; returns the reason when it cannot be done."""
        if self.airborne:
            return "flying"
        self.armed = False
        return None

    def set_mode(self, mode: Mode) -> str | None:
        """Change the mode; returns the reason when it cannot be done."""
        if mode == self.mode:
            return None
        if mode == Mode.AUTO and self._progress is None:
            return "no mission to fly"
        if mode == Mode.LOITER and not self.airborne:
            return "not flying"
        if mode == Mode.MANUAL and self.airborne:
            return "nobody at the sticks"
        if mode in (Mode.RTL, Mode.TAKEOFF, Mode.GUIDED):
            return "not yet"
        self.mode = mode
        if mode == Mode.LOITER:
            self._errors = None
            self._loiter_here()
        elif mode == Mode.AUTO and self.airborne:
            self._rejoin()
        return None

    def start_mission(self) -> str | None:
        """MAV_CMD_MISSION_START: fly the mission if armed; returns the reason when it cannot be done."""
        if not self.armed:
            return "not armed"
        return self.set_mode(Mode.AUTO)

    def drain_events(self) -> list[ItemReached | StatusText]:
        """What has happened since it was last asked."""
        events, self._events = self._events, []
        return events

    def report(self, text: StatusText) -> None:
        """Tell the stations something."""
        self._events.append(text)

    def snapshot(self) -> Snapshot:
        """What there is to know at this tick."""
        air, errors, progress, flying = self._flight.air, self._errors, self._progress, self.airborne
        thrust_fraction = self._flight.controls.thrust / thrust_max_n(air.V, self._config.airframe) if flying else 0.0
        return Snapshot(
            time_s=self.tick * TICK_S,
            mode=self.mode,
            armed=self.armed,
            airborne=flying,
            position_m=(air.x, air.y, air.h),
            ground_velocity_m_s=ground_velocity(self._flight) if flying else (0.0, 0.0, 0.0),
            airspeed_m_s=air.V,
            climb_angle=air.gamma,
            heading=air.chi,
            bank=self._flight.controls.bank,
            thrust_fraction=min(thrust_fraction, 1.0),
            wind_m_s=self._flight.wind,
            airspeed_wanted_m_s=self._airspeed_wanted(),
            current_seq=progress.current_seq if progress and flying else 0,
            mission_complete=progress.complete if progress else False,
            cross_track_m=errors.across if errors else 0.0,
            altitude_error_m=errors.above if errors else 0.0,
            along_track_m=errors.along if errors else 0.0,
            distance_to_waypoint_m=progress.distance_to_next_m(self._flight.point.s_m) if progress else 0.0,
            landed=LandedState.IN_AIR if flying else LandedState.ON_GROUND,
            home_m=self._home_m,
            in_formation=errors is not None,
            formation_delay_s=self._config.delay_ticks * TICK_S,
            fence_enabled=self.parameters["FENCE_ENABLE"] == 1,
        )

    # What the clock does, once a tick each.

    def observe(self) -> Correction:
        """Begin a tick: launch if it is time, feel the wind, find the place on the path, keep the truth.

        Returns:
            The own deviation at this tick, for the neighbours.
        """
        progress = self._progress
        if self.airborne:
            self._flight = in_next_wind(self._flight, next(self._normals), self._aircraft)
        elif self.armed and self.mode == Mode.AUTO and progress is not None:
            air = self._flight.air
            self._flight = launched((air.x, air.y, air.h), progress.tables, next(self._normals), self._aircraft)
            self._schedule_start_tick = self.tick
            self._events.append(StatusText(SEVERITY_INFO, "Launched"))
        self._errors = self._find_errors()
        self._truth.write(self._flight.air)
        errors = self._errors
        own = Correction(
            self._config.sysid,
            self.tick,
            self.tick,
            errors is not None,
            errors.along if errors else 0.0,
            errors.along_rate if errors else 0.0,
        )
        self._own.append(own)
        return own

    def advance(self, heard: Mapping[int, Correction]) -> None:
        """End a tick: decide, move, and note what has been reached.

        Args:
            heard: by neighbour, its deviation of `delay_ticks` ago; who is not heard is left out.
        """
        if self.airborne:
            if self._errors is not None:
                wanted = path_accelerations(self._errors, self._ahead(self._errors, heard))
                self._flight = moved(self._flight, wanted, self._aircraft)
                self._note_progress()
            else:
                self._flight = moved(self._flight, self._circling(), self._aircraft)
        self.tick += 1

    def _find_errors(self) -> PathErrors | None:
        """Deviations from the mission's path and schedule, while it flies one."""
        start, progress = self._schedule_start_tick, self._progress
        if start is None or progress is None or self.mode != Mode.AUTO or progress.complete:
            return None
        air, velocity = self._flight.air, ground_velocity(self._flight)
        time_s = (self.tick - start) * TICK_S
        errors, point = path_errors((air.x, air.y, air.h), velocity, time_s, self._flight.point, progress.tables)
        self._flight = at_point(self._flight, point)
        return errors

    def _ahead(self, errors: PathErrors, heard: Mapping[int, Correction]) -> float:
        """u_t: a plain autopilot's, or the law's with the corrections of neighbours that flew their schedule then."""
        if self._config.arm == "plain":
            return speed_acceleration(self._airspeed_wanted(), self._flight.air.V)
        then = self._own[0]
        corrections = 0.0
        if then.in_formation and then.tick == self.tick - self._config.delay_ticks:
            for sysid, weight in self._config.weights.items():
                other = heard.get(sysid)
                if other is not None and other.in_formation:
                    corrections += correction(
                        then.along_m, then.along_rate_m_s, other.along_m, other.along_rate_m_s, weight, self._gains
                    )
        return formation_acceleration(errors, corrections, self._gains)

    def _note_progress(self) -> None:
        progress = self._progress
        assert progress is not None
        for seq in progress.passed(self._flight.point.s_m, self._flight.air.h):
            self._events.append(ItemReached(seq))
        if progress.complete:
            self._loiter = progress.final_loiter()
            self._events.append(StatusText(SEVERITY_INFO, "Mission complete, loitering"))

    def _circling(self) -> Accelerations:
        assert self._loiter is not None
        air = self._flight.air
        return loiter_accelerations(
            (air.x, air.y, air.h), ground_velocity(self._flight), air.V, self._airspeed_wanted(), self._loiter
        )

    def _airspeed_wanted(self) -> float:
        """The airspeed commanded for this leg."""
        if self._progress is None:
            return self._config.airframe.airspeed_cruise_m_s
        return airspeed_at(self._flight.point.s_m, self._progress.tables.airspeeds)

    def _loiter_here(self) -> None:
        air = self._flight.air
        self._loiter = Loiter(air.x, air.y, air.h, fillet_radius_m(self._config.airframe.airspeed_max_m_s), -1.0)

    def _rejoin(self) -> None:
        """Come back to the mission where it is nearest; the schedule goes on from there."""
        progress = self._progress
        assert progress is not None
        if progress.complete:
            self._loiter = progress.final_loiter()
            return
        air = self._flight.air
        point, time_s = progress.rejoin(air.x, air.y, self._flight.point.s_m)
        self._flight = at_point(self._flight, point)
        self._schedule_start_tick = self.tick - round(time_s / TICK_S)
