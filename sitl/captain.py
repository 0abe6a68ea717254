"""Who decides what one vehicle flies: its mode, its mission, and which stage comes next."""

import math
from collections.abc import Callable, Sequence

from missions.commands import Command
from missions.environment.terrain import ground_height_m
from missions.errors import InputError
from missions.mission import Mission, MissionItem
from missions.reference.reference import FARTHEST_M, Speed, position_m
from sitl.circling import Circling
from sitl.config import VehicleConfig
from sitl.events import CRITICAL, INFO, NOTICE, WARNING, ItemReached, StatusText
from sitl.flight import Vector
from sitl.home import home_at
from sitl.homing import refuge
from sitl.itinerary import Flyer, Itinerary, Stage
from sitl.modes import Mode
from sitl.parameters import Parameters
from sitl.pilot import Phase, Pilot
from sitl.stages.circle import CircleStage
from sitl.stages.mark import Mark
from sitl.stages.path import PathStage
from sitl.stages.straight import GlideStage
from sitl.take_off import climb_out

DEFAULT_SPEED = -2.0
"""DO_CHANGE_SPEED back to what was planned."""


class Captain:
    """Decides; the commands return None when done, else the reason why not.

    Args:
        config: of the vehicle.
        parameters: what it is set to.
        report: told what happens.

    Attributes:
        pilot: flies what is decided.
        mode, armed: of the vehicle.
        home, home_m: where it returns to.
        rally: points that it may return to instead.
        itinerary: the mission.
        complete: the mission has been flown.
    """

    def __init__(
        self, config: VehicleConfig, parameters: Parameters, report: Callable[[ItemReached | StatusText], None]
    ) -> None:
        frame = config.frame
        self.mode = Mode.MANUAL
        self.armed = False
        self.home = home_at(config.home_m, frame)
        self.home_m = position_m(self.home, self.home, frame)
        self.rally: Sequence[MissionItem] = ()
        self._config = config
        self._parameters = parameters
        self._report = report
        self._circling = Circling(config, parameters)
        self.pilot = Pilot(config, self.home_m, self._circling.airspeeds)
        self.itinerary = self.planned(Mission((self.home,)))
        self.complete = False
        self._auto: Stage | None = None
        self._mark = self.itinerary.first()
        self._autoland: int | None = None
        self._climb_to_m = 0.0

    def set_current(self, seq: int) -> str | None:
        """Go on with this item of the mission, now or when AUTO is next; 0 and 1 are its beginning."""
        itinerary = self.itinerary
        if not 0 <= seq < len(itinerary.mission):
            return f"No item {seq}: the mission has {len(itinerary.mission) - 1}"
        if not itinerary.flies:
            return "No mission to fly"
        before = self._mark, self._auto, self.complete
        self._mark, self._auto, self.complete = itinerary.at(seq), None, False
        if self.pilot.airborne and self.mode != Mode.AUTO:
            return None
        try:
            self._continue()
        except InputError as error:
            self._mark, self._auto, self.complete = before
            return str(error)
        return None

    def change_speed(self, speed_m_s: float, *, over_ground: bool) -> str | None:
        """Fly at another speed from now on, until the mode changes; -2 for the default."""
        if not self.pilot.airborne:
            return "Not flying"
        slow, fast, _ = self._circling.airspeeds()
        if speed_m_s == DEFAULT_SPEED:
            self.pilot.commanded = None
            self.pilot.resume_schedule()
            return None
        if not over_ground and not slow <= speed_m_s <= fast:
            return f"{speed_m_s:g} m/s is not within AIRSPEED_MIN {slow:g} and AIRSPEED_MAX {fast:g}"
        if not 0.0 < speed_m_s < math.inf:
            return f"No such speed: {speed_m_s:g} m/s"
        self.pilot.commanded = Speed(speed_m_s, over_ground)
        return None

    def take_off(self, altitude_m: float) -> str | None:
        """Take off in mode TAKEOFF to an altitude above home."""
        if self.pilot.airborne:
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
        self.enter(Mode.GUIDED)
        self.circle((x, y, z), item.param3)
        return None

    def set_home(self, home: MissionItem | None) -> str | None:
        """Change home; None for where it is now, in the air the ground below."""
        frame, (x, y, z) = self._config.frame, self.pilot.start.position_m
        if home is None:
            home = home_at((x, y, ground_height_m(x, y, self._config.terrain) if self.pilot.airborne else z), frame)
        place = position_m(home, home, frame)
        if not (math.hypot(*place[:2]) < FARTHEST_M and abs(place[2]) < FARTHEST_M):
            return f"Home more than {FARTHEST_M / 1000:g} km away"
        before = self.home, self.home_m
        self.home, self.home_m = home, place
        try:
            itinerary = self.planned(self.itinerary.mission.with_home(home))
        except InputError as error:
            self.home, self.home_m = before
            return f"Home not changed: {error}"
        if self.pilot.airborne:
            self.itinerary = itinerary
        else:
            self.adopt(itinerary)
        return None

    def stop_engine(self) -> None:
        """Glide down straight ahead."""
        self.say(CRITICAL, "Disarmed in flight: gliding down, engine off")
        self.leave_auto()
        self.pilot.commanded = None
        self._autoland = None
        self.pilot.fly(GlideStage(self.pilot.start.course or 0.0, self._config.airframe))

    def start_mission(self) -> str | None:
        """Fly the mission from its first item, if armed."""
        if not self.armed:
            return "not armed"
        if not self.itinerary.flies:
            return "no mission to fly"
        return self.set_current(1) or self.set_mode(Mode.AUTO)

    def set_mode(self, mode: Mode) -> str | None:
        """Change the mode; returns the reason when it cannot be done."""
        if mode == self.mode:
            return None
        if not self.pilot.airborne:
            return self._set_mode_on_ground(mode)
        if mode == Mode.MANUAL:
            return "nobody at the sticks"
        if mode == Mode.TAKEOFF:
            return "TAKEOFF refused: already flying"
        if reason := self._no_flight():
            return f"{mode.name} refused: {reason}"
        if mode == Mode.AUTO:
            return self._enter_auto()
        self.enter(mode)
        if mode == Mode.RTL:
            self.return_home()
        else:
            self.circle_here()
        return None

    def _set_mode_on_ground(self, mode: Mode) -> str | None:
        if mode == Mode.AUTO and self._auto is None:
            return "no mission to fly"
        if mode in (Mode.LOITER, Mode.RTL, Mode.GUIDED):
            return "not flying"
        if mode == Mode.TAKEOFF:
            self._climb_to_m = self._parameters["TKOFF_ALT"]
        self.mode = mode
        return None

    def _enter_auto(self) -> str | None:
        if not self.itinerary.flies:
            return "no mission to fly"
        mode, auto, mark = self.mode, self._auto, self._mark
        self.enter(Mode.AUTO)
        if self._parameters["MIS_RESTART"] == 1:
            self._mark, self._auto, self.complete = self.itinerary.first(), None, False
        try:
            self._continue()
        except InputError as error:
            self.mode, self._auto, self._mark = mode, auto, mark
            return str(error)
        return None

    def enter(self, mode: Mode) -> None:
        """Change the mode, whatever that flies."""
        self.leave_auto()
        self.mode = mode
        self.pilot.commanded = None
        self._autoland = None

    def leave_auto(self) -> None:
        """Remember where the mission goes on."""
        if self.mode == Mode.AUTO and self._auto is not None:
            self._mark = self._auto.mark or self._mark

    def launch(self) -> None:
        """Armed and on the launcher: off, if the mode wants that."""
        if self.mode == Mode.AUTO:
            if self._auto is None:
                return
            self.pilot.fly(self._auto)
        elif self.mode == Mode.TAKEOFF:
            here = self.pilot.start.position_m
            top_m = max(self.home_m[2] + self._climb_to_m, here[2])
            self.pilot.fly(climb_out(here, top_m, self._config))
        else:
            return
        self.pilot.launch()
        self.complete = False
        self.say(INFO, "Launched")

    def note(self) -> None:
        """Go on where a stage is done; in the air, once a tick."""
        stage = self.pilot.stage
        if stage is None or isinstance(stage, GlideStage):
            return
        if stage.done:
            self._finish(stage)
        elif self._autoland is not None and isinstance(stage, CircleStage) and stage.arrived:
            self.land_at(self._autoland)

    def note_ground(self, was: Phase) -> None:
        """It has touched down, or come to rest."""
        stage = self.pilot.stage
        if was == Phase.FLYING:
            self.say(INFO, "Touchdown")
            if isinstance(stage, PathStage):
                self._report(ItemReached(stage.seq))
                self.complete = True
            return
        self.armed = False
        self._autoland = None
        self._mark, self._auto = self.itinerary.first(), None
        if self.itinerary.flies:
            try:
                self._continue()
            except InputError as error:
                self.say(WARNING, f"No take-off from here: {error}")
        self.say(INFO, "Landed and disarmed")

    def _finish(self, stage: Stage) -> None:
        """Its stage is done: on with the mission, or to a circle."""
        if self.mode == Mode.TAKEOFF:
            self.say(INFO, "Take-off complete, circling")
            self.circle_here()
            return
        if stage.seq and not isinstance(stage, PathStage):
            self._report(ItemReached(stage.seq))
        if isinstance(stage, PathStage) and stage.loiter_seq is not None:
            airspeed = self.pilot.airspeed_wanted_m_s
            circle = CircleStage(
                stage.final_loiter(), seq=stage.loiter_seq, airspeed_m_s=airspeed, mark=stage.mark, complete=True
            )
            self._fly_auto(circle)
            return
        self._mark = stage.mark or self._mark
        try:
            self._continue()
        except InputError as error:
            self.say(WARNING, f"Mission ends here: {error}")
            self._end_here()

    def _continue(self) -> None:
        """Fly the mission on from its mark, or have it ready on the ground. Raises InputError when it cannot be."""
        if self.pilot.airborne and self.complete and isinstance(self._auto, CircleStage):
            self.pilot.fly(self._auto)
            return
        stage, reached, _ = self.itinerary.stage(self._mark, self.pilot.start)
        if not self.pilot.airborne:
            self._auto = stage
            return
        for seq in reached:
            self._report(ItemReached(seq))
        if stage is None:
            self._end_here()
        else:
            self._fly_auto(stage)

    def _fly_auto(self, stage: Stage) -> None:
        self._auto = stage
        self.pilot.fly(stage)
        if isinstance(stage, CircleStage) and stage.complete:
            self.complete = True
            home = self.itinerary.mission[stage.seq].command == Command.NAV_RETURN_TO_LAUNCH
            self.say(INFO, f"Mission complete, {'flying home' if home else 'loitering'}")

    def _end_here(self) -> None:
        """The mission is over where it is: go on circling, or begin to."""
        last = self.pilot.stage
        loiter = (
            last.loiter if isinstance(last, CircleStage) else self._circling.loiter(self.pilot.start.position_m, 0.0)
        )
        seq = len(self.itinerary.mission) - 1
        self._fly_auto(CircleStage(loiter, seq=seq, mark=Mark(seq + 1, self._mark.speed), complete=True))

    def return_home(self) -> None:
        """RTL: straight to the landing sequence, or to a circle at home or a rally point."""
        starts, autoland = self.itinerary.landing_starts(), self._parameters["RTL_AUTOLAND"]
        here = self.pilot.start.position_m
        if starts and autoland in (1, 2):
            nearest = min(starts, key=lambda seq: math.dist(self.itinerary.place_m(seq + 1)[:2], here[:2]))
            if autoland == 2:
                self.land_at(nearest)
                return
            self._autoland = nearest
        self.pilot.fly(self._homeward(here))

    def _homeward(self, here: Vector) -> CircleStage:
        """The circle at home, or at a rally point."""
        goal = refuge(here, self.home, self.rally, self._config.frame, self._parameters)
        return self._circling.guarded(goal, self._parameters["RTL_RADIUS"], self._warn_of_terrain)

    def land_at(self, seq: int) -> None:
        """AUTO from a DO_LAND_START on."""
        self.enter(Mode.AUTO)
        self._mark, self._auto, self.complete = self.itinerary.at(seq), None, False
        self.say(NOTICE, f"Landing sequence from item {seq}")
        try:
            self._continue()
        except InputError as error:
            self.say(WARNING, f"No landing: {error}")
            self._end_here()

    def planned(self, mission: Mission) -> Itinerary:
        """A mission, checked. Raises InputError when it cannot be flown."""
        config = self._config
        flyer = Flyer(
            config.frame,
            config.airframe,
            config.terrain,
            config.forecast_wind_m_s,
            self._circling.loiter,
            self._homeward,
        )
        # A mission is begun from where it stands; one that comes while it flies, from home some day.
        start = self.home_m if self.pilot.airborne else self.pilot.start.position_m
        return Itinerary(mission, flyer, start)

    def adopt(self, itinerary: Itinerary, under_way: PathStage | None = None) -> None:
        """Take over a mission, to begin with its first item; or to go on along one of its paths that is flown."""
        self.itinerary = itinerary
        self._mark, self.complete = itinerary.first(), False
        self._auto = under_way if self.pilot.airborne else itinerary.first_stage
        if under_way is not None:
            self.pilot.change_path(under_way)
        self._parameters.tell("MIS_TOTAL", len(itinerary.mission))

    @property
    def current_seq(self) -> int:
        """The mission item that is flown, or will be when AUTO is next."""
        if self.mode == Mode.AUTO and self._auto is not None and self._auto.seq:
            return self._auto.seq
        return min(self._mark.seq, len(self.itinerary.mission) - 1)

    def _no_flight(self) -> str | None:
        if not self.pilot.airborne:
            return "not flying"
        return None if self.armed else "engine off"

    def circle(self, place: Vector, radius_m: float) -> None:
        """Fly to a place and circle there; the radius is signed, 0 for the default."""
        self.pilot.fly(self._circling.guarded(place, radius_m, self._warn_of_terrain))

    def circle_here(self) -> None:
        """Circle where it is."""
        self.circle(self.pilot.start.position_m, 0.0)

    def _warn_of_terrain(self, z_m: float) -> None:
        self.say(WARNING, f"Terrain ahead: climbing to {z_m - self.home_m[2]:.0f} m above home")

    def say_refusal(self, reason: str | None) -> None:
        """Tell the stations why a failsafe could not do what it should."""
        if reason is not None:
            self.say(WARNING, reason)

    def say(self, severity: int, text: str) -> None:
        """Tell the stations something."""
        self._report(StatusText(severity, text))
