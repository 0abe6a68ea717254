"""One simulated vehicle: what a pilot may ask of it, and what it does on its own at each tick."""

import math
import threading
from collections.abc import Callable, Mapping, Sequence

from missions.airframe import thrust_max_n
from missions.commands import Command, Frame
from missions.environment.terrain import ground_height_m
from missions.errors import InputError
from missions.fence import parse_fence
from missions.mission import Mission, MissionItem
from missions.plan_type import PlanType
from missions.reference.reference import FARTHEST_M, Speed, fillet_radius_m, position_m
from sitl.config import VehicleConfig
from sitl.events import ItemReached, StatusText
from sitl.failsafe import FenceAction, StationAction, fence_return
from sitl.fence_watch import FenceAreas, FenceWatch
from sitl.flight import Vector, ground_velocity
from sitl.formation.correction import Correction
from sitl.guidance.loiter_law import Loiter
from sitl.homing import check_rally, refuge
from sitl.itinerary import Flyer, Itinerary, Stage
from sitl.modes import Mode
from sitl.parameters import Parameters, arduplane_parameters
from sitl.pilot import Phase, Pilot
from sitl.plan_memory import keep_plan, recall_plan
from sitl.prearm import reason_not_to_arm
from sitl.snapshot import LandedState, Snapshot
from sitl.stages.circle import CircleStage
from sitl.stages.mark import Mark
from sitl.stages.path import PathStage
from sitl.stages.straight import ClimbOutStage, GlideStage
from sitl.station_watch import StationWatch
from sitl.store import Store
from sitl.take_off import climb_out
from sitl.terrain_guard import TerrainGuard
from sitl.ticks import TICK_S
from sitl.truth import TruthWriter

CRITICAL, WARNING, NOTICE, INFO = 2, 4, 5, 6
"""MAV_SEVERITY."""
_TOTALS = {PlanType.MISSION: "MIS_TOTAL", PlanType.FENCE: "FENCE_TOTAL", PlanType.RALLY: "RALLY_TOTAL"}
_DEFAULT_SPEED = -2.0


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
        self._config = config
        self._truth = truth
        self._store = store or Store()
        self.parameters = Parameters(arduplane_parameters(config.sysid, config.airframe), self._store)
        self._home_m = position_m(self.home, self.home, config.frame)
        self._pilot = Pilot(config, self._home_m, self._airspeeds)
        self._fence = FenceWatch(self.parameters)
        self._station = StationWatch()
        self._events: list[ItemReached | StatusText] = []
        self._plans: dict[PlanType, tuple[MissionItem, ...]] = {PlanType.FENCE: (), PlanType.RALLY: ()}
        self._itinerary = self._planned(Mission((self.home,)))
        self._auto: Stage | None = None
        self._mark = self._itinerary.first()
        self._complete = False
        self._failsafe = False
        self._autoland: int | None = None
        self._climb_to_m = 0.0
        self._recall()

    # What a pilot may ask.

    @property
    def sysid(self) -> int:
        """MAVLink system id; to its neighbours it stays what it was configured as."""
        return int(self.parameters["MAV_SYSID"])

    @property
    def mission(self) -> Mission:
        """The mission held."""
        return self._itinerary.mission

    @property
    def airborne(self) -> bool:
        """Whether it is in the air."""
        return self._pilot.airborne

    def items(self, plan: PlanType) -> tuple[MissionItem, ...]:
        """The plan held of one type; a mission has at least home."""
        return self.mission.items if plan == PlanType.MISSION else self._plans[plan]

    def load(self, plan: PlanType, items: Sequence[MissionItem]) -> None:
        """Keep a plan and take it over; item 0 of a mission is replaced by home.

        Raises:
            InputError: it cannot be flown, is being flown, or could not be kept; the message says why, and the old one
                stays.
        """
        held = tuple(items)
        if plan == PlanType.MISSION:
            held = (self.home, *held[1:])
            if self.airborne and self.mode == Mode.AUTO:
                raise InputError("mission: it is being flown; change to LOITER first")
        take = self._checked(plan, held)
        keep_plan(self._store, plan, held)
        take()

    def set_current(self, seq: int) -> str | None:
        """Go on with this item of the mission, now or when AUTO is next; 0 and 1 are its beginning."""
        itinerary = self._itinerary
        if not 0 <= seq < len(itinerary.mission):
            return f"No item {seq}: the mission has {len(itinerary.mission) - 1}"
        if not itinerary.flies:
            return "No mission to fly"
        before = self._mark, self._auto, self._complete
        self._mark, self._auto, self._complete = itinerary.at(seq), None, False
        if self.airborne and self.mode != Mode.AUTO:
            return None
        try:
            self._continue()
        except InputError as error:
            self._mark, self._auto, self._complete = before
            return str(error)
        return None

    def change_speed(self, speed_m_s: float, *, over_ground: bool) -> str | None:
        """Fly at another speed from now on, until the mode or the mission changes it; -2 for the default."""
        if not self.airborne:
            return "Not flying"
        slow, fast, _ = self._airspeeds()
        if speed_m_s == _DEFAULT_SPEED:
            self._pilot.commanded = None
            self._pilot.resume_schedule(self.tick)
            return None
        if not over_ground and not slow <= speed_m_s <= fast:
            return f"{speed_m_s:g} m/s is not within AIRSPEED_MIN {slow:g} and AIRSPEED_MAX {fast:g}"
        if not 0.0 < speed_m_s < math.inf:
            return f"No such speed: {speed_m_s:g} m/s"
        self._pilot.commanded = Speed(speed_m_s, over_ground)
        return None

    def take_off(self, altitude_m: float) -> str | None:
        """Take off in mode TAKEOFF to an altitude above home."""
        if self.airborne:
            return "Already flying"
        if not self.armed:
            return "Take-off refused: not armed"
        if not 0.0 < altitude_m < FARTHEST_M:
            return f"Take-off to {altitude_m:g} m above home"
        self._climb_to_m = altitude_m
        self.mode = Mode.TAKEOFF
        return None

    def reposition(self, item: MissionItem) -> str | None:
        """Fly to a place in mode GUIDED and circle there."""
        if reason := self._no_flight():
            return f"GUIDED refused: {reason}"
        x, y, z = position_m(item, self.home, self._config.frame)
        if not (math.hypot(x, y) < FARTHEST_M and abs(z) < FARTHEST_M and math.isfinite(item.param3)):
            return f"GUIDED refused: no such place within {FARTHEST_M / 1000:g} km"
        self._enter(Mode.GUIDED)
        self._circle((x, y, z), item.param3)
        return None

    def set_home(self, home: MissionItem | None) -> str | None:
        """Change home; None for where it is now, in the air the ground below."""
        frame, (x, y, z) = self._config.frame, self._pilot.start.position_m
        if home is None:
            lat_e7, lon_e7 = frame.to_e7(x, y)
            z = ground_height_m(x, y, self._config.terrain) if self.airborne else z
            home = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=z + frame.alt_m)
        place = position_m(home, home, frame)
        if not (math.hypot(*place[:2]) < FARTHEST_M and abs(place[2]) < FARTHEST_M):
            return f"Home more than {FARTHEST_M / 1000:g} km away"
        before = self.home, self._home_m
        self.home, self._home_m = home, place
        try:
            itinerary = self._planned(self.mission.with_home(home))
            if not self.airborne:
                self._adopt(itinerary)
        except InputError as error:
            self.home, self._home_m = before
            return f"Home not changed: {error}"
        self._itinerary = itinerary
        return None

    def enable_fence(self, enabled: bool) -> str | None:
        """Heed the fence, or not: sets FENCE_ENABLE."""
        if enabled and (missing := self._fence.missing()) is not None:
            return missing
        try:
            self.parameters.set("FENCE_ENABLE", float(enabled))
        except InputError as error:
            return str(error)
        return None

    def hear_station(self, now_s: float) -> None:
        """The station has been heard."""
        if self._station.hear(now_s):
            self._say(NOTICE, "Station is back")
            self._failsafe = self._fence.breached

    def watch_station(self, now_s: float) -> None:
        """Wall time has passed: in flight, if the station has been silent for too long, do what FS_LONG_ACTN says."""
        settings = self.parameters
        heeded = settings["FS_GCS_ENABL"]
        if not self.airborne or not self.armed or heeded == 0 or (heeded == 3 and self.mode != Mode.AUTO):
            return
        if not self._station.falls_silent(now_s, settings["FS_LONG_TIMEOUT"]):
            return
        self._failsafe = True
        action = StationAction(int(settings["FS_LONG_ACTN"]))
        self._say(CRITICAL, f"Station lost for {settings['FS_LONG_TIMEOUT']:g} s: {action.words}")
        if action == StationAction.RTL and self.mode != Mode.RTL and not self._landing:
            self._say_refusal(self.set_mode(Mode.RTL))
        elif action == StationAction.AUTO:
            self._say_refusal(self.set_mode(Mode.AUTO))

    def prearm(self) -> str | None:
        """Why it could not be armed now."""
        return reason_not_to_arm(
            self.mode,
            flies=self._itinerary.flies,
            parameters=self.parameters,
            fence=self._fence,
            home_m=self._home_m,
            here_m=self._pilot.start.position_m,
            terrain=self._config.terrain,
        )

    def arm(self, *, force: bool = False) -> str | None:
        """Arm; in the air, by force, that starts the engine again, and it circles."""
        if self.armed:
            return None
        if self._pilot.phase == Phase.ROLLING:
            return "Still rolling"
        if self.airborne:
            if not force:
                return "Gliding with the engine off: arm by force"
            self.armed = True
            self._enter(Mode.LOITER)
            self._circle_here()
            return None
        if not force and (reason := self.prearm()) is not None:
            return reason
        self.armed = True
        return None

    def disarm(self, *, force: bool = False) -> str | None:
        """Disarm; by force in the air too, where it then glides down straight ahead."""
        if self.airborne and self.armed:
            if not force:
                return "flying"
            self._say(CRITICAL, "Disarmed in flight: gliding down, engine off")
            self._leave_auto()
            self._pilot.commanded = None
            self._pilot.fly(GlideStage(self._course, self._config.airframe), self.tick)
        self.armed = False
        return None

    def set_mode(self, mode: Mode) -> str | None:
        """Change the mode; returns the reason when it cannot be done."""
        if mode == self.mode:
            return None
        if not self.airborne:
            return self._set_mode_on_ground(mode)
        if mode == Mode.MANUAL:
            return "nobody at the sticks"
        if mode == Mode.TAKEOFF:
            return "TAKEOFF refused: already flying"
        if reason := self._no_flight():
            return f"{mode.name} refused: {reason}"
        if mode == Mode.AUTO:
            return self._enter_auto()
        self._enter(mode)
        if mode == Mode.RTL:
            self._return()
        else:
            self._circle_here()
        return None

    def start_mission(self) -> str | None:
        """Fly the mission from its first item, if armed."""
        if not self.armed:
            return "not armed"
        if not self._itinerary.flies:
            return "no mission to fly"
        return self.set_current(1) or self.set_mode(Mode.AUTO)

    def drain_events(self) -> list[ItemReached | StatusText]:
        """What has happened since it was last asked."""
        events, self._events = self._events, []
        return events

    def report(self, text: StatusText) -> None:
        """Tell the stations something."""
        self._events.append(text)

    def snapshot(self) -> Snapshot:
        """What there is to know at this tick."""
        pilot, fence, flying = self._pilot, self._fence, self.airborne
        flight, errors, stage = pilot.flight, pilot.errors, pilot.stage
        air = flight.air
        thrust_fraction = flight.controls.thrust / thrust_max_n(air.V, self._config.airframe) if flying else 0.0
        rolling = (air.V * math.cos(air.chi), air.V * math.sin(air.chi), 0.0)
        distance_m = 0.0
        if isinstance(stage, PathStage):
            distance_m = stage.distance_m(flight.point.s_m)
        elif isinstance(stage, CircleStage) and not stage.complete:
            distance_m = stage.distance_m(flight)
        return Snapshot(
            time_s=self.tick * TICK_S,
            mode=self.mode,
            armed=self.armed,
            airborne=flying,
            position_m=(air.x, air.y, air.h),
            ground_velocity_m_s=ground_velocity(flight) if flying else rolling,
            airspeed_m_s=air.V,
            climb_angle=air.gamma,
            heading=air.chi,
            bank=flight.controls.bank,
            thrust_fraction=min(thrust_fraction, 1.0),
            wind_m_s=flight.wind,
            airspeed_wanted_m_s=pilot.airspeed_wanted_m_s,
            current_seq=self._current_seq if flying else 0,
            mission_complete=self._complete,
            cross_track_m=errors.across if errors else 0.0,
            altitude_error_m=errors.above if errors else 0.0,
            along_track_m=errors.along if errors else 0.0,
            distance_to_waypoint_m=distance_m,
            landed=self._landed,
            home_m=self._home_m,
            ready=self.armed or flying or self.prearm() is None,
            failsafe=self._failsafe,
            in_formation=pilot.in_formation,
            formation_delay_s=self._config.delay_ticks * TICK_S,
            fence_enabled=fence.enabled,
            breach_status=fence.breached,
            breach_count=fence.count,
            breach_type=fence.last,
            breach_time_s=fence.last_time_s,
        )

    # What the clock does, once a tick each.

    def observe(self) -> Correction:
        """Begin a tick: launch if it is time, feel the wind, find the place on the path, keep the truth.

        Returns:
            The own deviation at this tick, for the neighbours.
        """
        pilot = self._pilot
        if pilot.airborne:
            pilot.feel()
        elif self.armed and pilot.phase == Phase.PARKED:
            self._launch()
        own = pilot.observe(self.tick)
        self._truth.write(pilot.flight.air)
        return own

    def advance(self, heard: Mapping[int, Correction]) -> None:
        """End a tick: decide, move, and note what has been reached.

        Args:
            heard: by neighbour, its deviation of `delay_ticks` ago; who is not heard is left out.
        """
        pilot = self._pilot
        if pilot.phase != Phase.PARKED:
            was = pilot.phase
            pilot.advance(heard, self.tick)
            self._note(was)
        self.tick += 1

    def _launch(self) -> None:
        if self.mode == Mode.AUTO:
            if self._auto is None:
                return
            self._pilot.fly(self._auto, self.tick)
        elif self.mode == Mode.TAKEOFF:
            here = self._pilot.start.position_m
            top_m = max(self._home_m[2] + self._climb_to_m, here[2])
            self._pilot.fly(climb_out(here, top_m, self._config), self.tick)
        else:
            return
        self._pilot.launch(self.tick)
        self._complete = False
        self._say(INFO, "Launched")

    def _note(self, was: Phase) -> None:
        """What the tick has brought."""
        pilot = self._pilot
        for seq in pilot.reached:
            self._events.append(ItemReached(seq))
        pilot.reached.clear()
        if pilot.phase != was:
            self._note_ground(was)
            return
        if not self.airborne:
            return
        stage = pilot.stage
        if isinstance(stage, PathStage | CircleStage | ClimbOutStage) and stage.done:
            self._finish(stage)
        elif self._autoland is not None and isinstance(stage, CircleStage) and stage.arrived:
            self._land_at(self._autoland)
        if self._fence.enabled:
            self._heed_fence()
        elif self._fence.breached:
            self._fence.rest()

    def _note_ground(self, was: Phase) -> None:
        """It has touched down, or come to rest."""
        stage = self._pilot.stage
        if was == Phase.FLYING:
            self._fence.rest()
            self._say(INFO, "Touchdown")
            if isinstance(stage, PathStage):
                self._events.append(ItemReached(stage.seq))
                self._complete = True
            return
        self.armed = self._failsafe = False
        self._autoland = None
        self._mark, self._auto = self._itinerary.first(), None
        if self._itinerary.flies:
            try:
                self._continue()
            except InputError as error:
                self._say(WARNING, f"No take-off from here: {error}")
        self._say(INFO, "Landed and disarmed")

    def _finish(self, stage: Stage) -> None:
        """Its stage is done: on with the mission, or to a circle."""
        if self.mode == Mode.TAKEOFF:
            self._say(INFO, "Take-off complete, circling")
            self._circle_here()
            return
        if stage.seq and not isinstance(stage, PathStage):
            self._events.append(ItemReached(stage.seq))
        if isinstance(stage, PathStage) and stage.loiter_seq is not None:
            airspeed = self._pilot.airspeed_wanted_m_s
            circle = CircleStage(
                stage.final_loiter(), seq=stage.loiter_seq, airspeed_m_s=airspeed, mark=stage.mark, complete=True
            )
            self._fly_auto(circle)
            return
        self._mark = stage.mark or self._mark
        try:
            self._continue()
        except InputError as error:
            self._say(WARNING, f"Mission ends here: {error}")
            self._end_here()

    # Modes.

    def _set_mode_on_ground(self, mode: Mode) -> str | None:
        if mode == Mode.AUTO and self._auto is None:
            return "no mission to fly"
        if mode in (Mode.LOITER, Mode.RTL, Mode.GUIDED):
            return "not flying"
        if mode == Mode.TAKEOFF:
            self._climb_to_m = self.parameters["TKOFF_ALT"]
        self.mode = mode
        return None

    def _enter_auto(self) -> str | None:
        if not self._itinerary.flies:
            return "no mission to fly"
        mode, auto, mark = self.mode, self._auto, self._mark
        self._enter(Mode.AUTO)
        if self.parameters["MIS_RESTART"] == 1:
            self._mark, self._auto, self._complete = self._itinerary.first(), None, False
        try:
            self._continue()
        except InputError as error:
            self.mode, self._auto, self._mark = mode, auto, mark
            return str(error)
        return None

    def _enter(self, mode: Mode) -> None:
        self._leave_auto()
        self.mode = mode
        self._pilot.commanded = None
        self._autoland = None

    def _leave_auto(self) -> None:
        if self.mode == Mode.AUTO and self._auto is not None:
            self._mark = self._auto.mark or self._mark

    def _continue(self) -> None:
        """Fly the mission on from its mark, or have it ready on the ground. Raises InputError when it cannot be."""
        if self.airborne and self._complete and isinstance(self._auto, CircleStage):
            self._pilot.fly(self._auto, self.tick)
            return
        stage, reached, _ = self._itinerary.stage(self._mark, self._pilot.start)
        if not self.airborne:
            self._auto = stage
            return
        self._events.extend(ItemReached(seq) for seq in reached)
        if stage is None:
            self._end_here()
        else:
            self._fly_auto(stage)

    def _fly_auto(self, stage: Stage) -> None:
        self._auto = stage
        self._pilot.fly(stage, self.tick)
        if isinstance(stage, CircleStage) and stage.complete:
            self._complete = True
            self._say(INFO, "Mission complete, loitering")

    def _end_here(self) -> None:
        """The mission is over where it is: go on circling, or begin to."""
        last = self._pilot.stage
        loiter = last.loiter if isinstance(last, CircleStage) else self._loiter_here()
        seq = len(self.mission) - 1
        self._fly_auto(CircleStage(loiter, seq=seq, mark=Mark(seq + 1, self._mark.speed), complete=True))

    def _return(self) -> None:
        """RTL: straight to the landing sequence, or to a circle at home or a rally point."""
        starts, autoland = self._itinerary.landing_starts(), self.parameters["RTL_AUTOLAND"]
        here = self._pilot.start.position_m
        if starts and autoland in (1, 2):
            nearest = min(starts, key=lambda seq: math.dist(self._itinerary.place_m(seq + 1)[:2], here[:2]))
            if autoland == 2:
                self._land_at(nearest)
                return
            self._autoland = nearest
        self._pilot.fly(self._homeward(here), self.tick)

    def _homeward(self, here: Vector) -> CircleStage:
        goal = refuge(here, self.home, self._plans[PlanType.RALLY], self._config.frame, self.parameters)
        self._say(NOTICE, f"Returning to {goal.name}")
        radius_m = self._radius_m(self.parameters["RTL_RADIUS"])
        return self._guarded(goal.position_m, radius_m)

    def _land_at(self, seq: int) -> None:
        """AUTO from a DO_LAND_START on."""
        self._enter(Mode.AUTO)
        self._mark, self._auto, self._complete = self._itinerary.at(seq), None, False
        self._say(NOTICE, f"Landing sequence from item {seq}")
        try:
            self._continue()
        except InputError as error:
            self._say(WARNING, f"No landing: {error}")
            self._end_here()

    # Fence.

    def _heed_fence(self) -> None:
        place = self._pilot.start.position_m
        news = self._fence.look(place, self._home_m, self.tick * TICK_S, landing=self._landing)
        if news is None:
            return
        if isinstance(news, bool):
            self._failsafe = self._station.lost
            self._say(NOTICE, "Back inside the fence")
            return
        action = FenceAction(int(self.parameters["FENCE_ACTION"]))
        self._say(CRITICAL, f"Fence breached, {news.text}: {action.words}")
        if action == FenceAction.REPORT or not self.armed:
            return
        self._failsafe = True
        if action in (FenceAction.GUIDED, FenceAction.GUIDED_THROTTLE):
            areas, rally, frame = self._fence.areas, self._plans[PlanType.RALLY], self._config.frame
            goal = fence_return(place, areas, self.home, rally, frame, self.parameters)
            self._enter(Mode.GUIDED)
            self._circle(goal, 0.0)
        elif action == FenceAction.AUTOLAND and (starts := self._itinerary.landing_starts()):
            self._land_at(starts[0])
        elif self.mode != Mode.RTL:
            self._say_refusal(self.set_mode(Mode.RTL))

    # Plans.

    def _checked(self, plan: PlanType, items: tuple[MissionItem, ...]) -> Callable[[], None]:
        """What takes over a plan. Raises InputError when it cannot be flown."""
        if plan == PlanType.MISSION:
            itinerary = self._planned(Mission(items))
            return lambda: self._adopt(itinerary)
        areas = FenceAreas(parse_fence(items), self._config.frame) if plan == PlanType.FENCE else None
        if plan == PlanType.RALLY:
            check_rally(items, self._config.frame)

        def take() -> None:
            self._plans[plan] = items
            self.parameters.tell(_TOTALS[plan], len(items))
            if areas is not None:
                self._fence.areas = areas

        return take

    def _planned(self, mission: Mission) -> Itinerary:
        """Raises InputError when it cannot be flown."""
        config = self._config
        flyer = Flyer(
            config.frame,
            config.airframe,
            config.terrain,
            config.forecast_wind_m_s,
            self._radius_m,
            self._homeward,
        )
        # A mission is begun from where it stands; one that comes while it flies, from home some day.
        start = self._home_m if self.airborne else self._pilot.start.position_m
        return Itinerary(mission, flyer, start)

    def _adopt(self, itinerary: Itinerary) -> None:
        self._itinerary = itinerary
        self._mark, self._complete = itinerary.first(), False
        self._auto = None if self.airborne else itinerary.first_stage
        self.parameters.tell("MIS_TOTAL", len(itinerary.mission))

    def _recall(self) -> None:
        """The plans that were kept; without those that are damaged or can no longer be flown."""
        self.parameters.tell("MIS_TOTAL", 1)
        for plan in (PlanType.MISSION, PlanType.FENCE, PlanType.RALLY):
            try:
                if (items := recall_plan(self._store, plan)) is not None:
                    held = (self.home, *items[1:]) if plan == PlanType.MISSION else items
                    self._checked(plan, held)()
            except InputError as error:
                self._say(WARNING, f"Kept {plan.name.lower()} not used: {error}")

    # The rest.

    @property
    def _landing(self) -> bool:
        stage = self._pilot.stage
        return isinstance(stage, GlideStage) or (isinstance(stage, PathStage) and stage.on_final)

    @property
    def _landed(self) -> LandedState:
        stage = self._pilot.stage
        if not self.airborne:
            return LandedState.ON_GROUND
        if self._landing:
            return LandedState.LANDING
        taking_off = isinstance(stage, ClimbOutStage) or (isinstance(stage, PathStage) and stage.taking_off)
        return LandedState.TAKING_OFF if taking_off else LandedState.IN_AIR

    @property
    def _current_seq(self) -> int:
        if self.mode == Mode.AUTO and self._auto is not None and self._auto.seq:
            return self._auto.seq
        return min(self._mark.seq, len(self.mission) - 1)

    @property
    def _course(self) -> float:
        return self._pilot.start.course or 0.0

    def _no_flight(self) -> str | None:
        if not self.airborne:
            return "not flying"
        return None if self.armed else "engine off"

    def _airspeeds(self) -> tuple[float, float, float]:
        """(least, greatest, cruise) airspeed that is set."""
        slow, fast = sorted((self.parameters["AIRSPEED_MIN"], self.parameters["AIRSPEED_MAX"]))
        return slow, fast, self.parameters["AIRSPEED_CRUISE"]

    def _radius_m(self, asked_m: float) -> float:
        """A circle's radius, positive clockwise: as asked, else WP_LOITER_RAD; never tighter than it can be flown."""
        wanted = asked_m or self.parameters["WP_LOITER_RAD"]
        _, fast, cruise = self._airspeeds()
        least = fillet_radius_m(min(cruise, fast) + math.hypot(*self._config.forecast_wind_m_s))
        return math.copysign(max(abs(wanted), least), wanted)

    def _circle(self, place: Vector, radius_m: float) -> None:
        self._pilot.fly(self._guarded(place, self._radius_m(radius_m)), self.tick)

    def _circle_here(self) -> None:
        self._pilot.fly(CircleStage(self._loiter_here(), guard=self._guard()), self.tick)

    def _loiter_here(self) -> Loiter:
        (x, y, z), radius_m = self._pilot.start.position_m, self._radius_m(0.0)
        return Loiter(x, y, z, abs(radius_m), -1.0 if radius_m > 0 else 1.0)

    def _guarded(self, place: Vector, radius_m: float) -> CircleStage:
        x, y, z = place
        return CircleStage(Loiter(x, y, z, abs(radius_m), -1.0 if radius_m > 0 else 1.0), guard=self._guard())

    def _guard(self) -> TerrainGuard:
        def warn(z_m: float) -> None:
            self._say(WARNING, f"Terrain ahead: climbing to {z_m - self._home_m[2]:.0f} m above home")

        return TerrainGuard(self._config.terrain, abs(self._radius_m(0.0)), warn)

    def _say(self, severity: int, text: str) -> None:
        self._events.append(StatusText(severity, text))

    def _say_refusal(self, reason: str | None) -> None:
        if reason is not None:
            self._say(WARNING, reason)
