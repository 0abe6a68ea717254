"""What a vehicle does on its own when it crosses its fence, or when its station falls silent."""

from sitl.captain import Captain
from sitl.config import VehicleConfig
from sitl.events import CRITICAL, NOTICE
from sitl.fence_action import FenceAction, fence_return
from sitl.fence_watch import FenceWatch
from sitl.landed_state import is_landing
from sitl.modes import Mode
from sitl.parameters import Parameters
from sitl.station_watch import StationAction, StationWatch
from sitl.ticks import TICK_S


class Failsafes:
    """Watches fence and station, and tells the captain.

    Args:
        captain: who obeys.
        config: of the vehicle.
        parameters: FENCE_*, FS_*.

    Attributes:
        fence: what has been crossed.
        active: something has made it act, and is not over.
    """

    def __init__(self, captain: Captain, config: VehicleConfig, parameters: Parameters) -> None:
        self.fence = FenceWatch(parameters)
        self.active = False
        self._station = StationWatch()
        self._captain = captain
        self._frame = config.frame
        self._parameters = parameters

    def hear_station(self, now_s: float) -> None:
        """The station has been heard."""
        if self._station.hear(now_s):
            self._captain.say(NOTICE, "Station is back")
            self.active = self.fence.breached

    def watch_station(self, now_s: float) -> None:
        """Wall time has passed: in flight, if the station has been silent for too long, do what FS_LONG_ACTN says."""
        captain, settings = self._captain, self._parameters
        heeded = settings["FS_GCS_ENABL"]
        if not (captain.pilot.airborne and captain.armed) or heeded == 0 or (heeded == 3 and captain.mode != Mode.AUTO):
            return
        if not self._station.falls_silent(now_s, settings["FS_LONG_TIMEOUT"]):
            return
        self.active = True
        action = StationAction(int(settings["FS_LONG_ACTN"]))
        captain.say(CRITICAL, f"Station lost for {settings['FS_LONG_TIMEOUT']:g} s: {action.words}")
        if action == StationAction.RTL and not is_landing(captain.pilot.stage):
            captain.say_refusal(captain.set_mode(Mode.RTL))
        elif action == StationAction.AUTO:
            captain.say_refusal(captain.set_mode(Mode.AUTO))

    def heed_fence(self) -> None:
        """In flight, once a tick: has the fence been crossed, either way?"""
        captain, fence = self._captain, self.fence
        if not fence.enabled:
            if fence.breached:
                self._end_breach()
            return
        here = captain.pilot.start.position_m
        news = fence.look(here, captain.home_m, captain.pilot.tick * TICK_S, landing=is_landing(captain.pilot.stage))
        if news is None:
            return
        if isinstance(news, bool):
            self._end_breach()
            captain.say(NOTICE, "Back inside the fence")
            return
        action = FenceAction(int(self._parameters["FENCE_ACTION"]))
        words = action.words if captain.armed else "engine off"
        captain.say(CRITICAL, f"Fence breached, {news.text}: {words}")
        if action == FenceAction.REPORT or not captain.armed:
            return
        self.active = True
        starts = captain.itinerary.landing_starts()
        if action in (FenceAction.GUIDED, FenceAction.GUIDED_THROTTLE):
            goal = fence_return(here, fence.areas, captain.home, captain.rally, self._frame, self._parameters)
            captain.enter(Mode.GUIDED)
            captain.circle(goal, 0.0)
        elif action == FenceAction.AUTOLAND and starts:
            captain.land_at(starts[0])
        else:
            captain.say_refusal(captain.set_mode(Mode.RTL))

    def rest(self) -> None:
        """The flight is over."""
        self.fence.rest()
        self.active = False

    def _end_breach(self) -> None:
        self.fence.breached = False
        self.active = self._station.lost
