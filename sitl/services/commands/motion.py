"""Speed, take-off, and flying to a place."""

import math
from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.commands import Command, Frame
from missions.mission import MissionItem
from sitl.modes import Mode
from sitl.services.commands.place import place_of
from sitl.services.commands.request import ACCEPTED, INT_ONLY, Answer, Handler, Request, denied, failed, outcome
from sitl.services.stream_messages.view import View
from sitl.services.vehicle import Vehicle

_UNCHANGED, _DEFAULT = -1.0, -2.0
_CHANGE_MODE = int(mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE)


class MotionCommands:
    """DO_CHANGE_SPEED, NAV_TAKEOFF and DO_REPOSITION.

    Args:
        vehicle: who flies.
        view: gives where it is.
    """

    def __init__(self, vehicle: Vehicle, view: Callable[[], View]) -> None:
        self._vehicle = vehicle
        self._view = view
        self.handlers: dict[int, Handler] = {
            mavlink.MAV_CMD_DO_CHANGE_SPEED: self._change_speed,
            mavlink.MAV_CMD_NAV_TAKEOFF: self._take_off,
            mavlink.MAV_CMD_DO_REPOSITION: self._reposition,
        }

    def _change_speed(self, request: Request) -> Answer:
        """Airspeed (type 0) or ground speed (1) in param2; throttle, param3, is not for the asking."""
        kind, speed_m_s = request.param1, request.param2
        if kind not in (mavlink.SPEED_TYPE_AIRSPEED, mavlink.SPEED_TYPE_GROUNDSPEED) or request.param3 > 0:
            return denied("DO_CHANGE_SPEED takes airspeed (0) or ground speed (1), and no throttle")
        if speed_m_s == _UNCHANGED:
            return ACCEPTED
        if not (speed_m_s == _DEFAULT or 0.0 < speed_m_s < math.inf):
            return denied(f"No such speed: {speed_m_s:g} m/s")
        over_ground = kind == mavlink.SPEED_TYPE_GROUNDSPEED
        return outcome(self._vehicle.change_speed(speed_m_s, over_ground=over_ground))

    def _take_off(self, request: Request) -> Answer:
        """Straight ahead to the altitude in param7, wherever params 5 and 6 are; to TKOFF_ALT when there is none.

        As on ArduPilot the altitude of a COMMAND_LONG is above home.
        """
        if math.isnan(request.z_m) or request.z_m == 0.0:
            return outcome(self._vehicle.take_off(self._vehicle.parameters["TKOFF_ALT"]))
        place = place_of(request, self._view())
        if isinstance(place, Answer):
            return place
        above_home_m = place[2] - self._view().home.alt_m if request.whole else request.z_m
        if not above_home_m > 0.0:
            return denied(f"Take-off to {above_home_m:g} m above home")
        return outcome(self._vehicle.take_off(above_home_m))

    def _reposition(self, request: Request) -> Answer:
        """To a place in GUIDED, circling clockwise unless param4 says otherwise, param3 metres from it if positive.

        A COMMAND_LONG would round the place to half a metre and does not say what its altitude is above.
        """
        if not request.whole:
            return INT_ONLY
        view = self._view()
        place = place_of(request, view)
        if isinstance(place, Answer):
            return place
        if any(math.isinf(value) for value in (request.param1, request.param2, request.param3, request.param4)):
            return denied()
        changes_mode = bool(_flags(request.param2) & _CHANGE_MODE)
        if not (changes_mode or view.snapshot.mode == Mode.GUIDED):
            return failed("DO_REPOSITION: not in GUIDED, and not told to change mode")
        lat_e7, lon_e7, altitude_m = place
        item = MissionItem(
            Command.NAV_LOITER_UNLIM,
            Frame.GLOBAL,
            param3=self._radius_m(request),
            lat_e7=lat_e7,
            lon_e7=lon_e7,
            alt_m=altitude_m,
        )
        done = outcome(self._vehicle.reposition(item))
        if done == ACCEPTED and request.param1 > 0.0:
            return outcome(self._vehicle.change_speed(request.param1, over_ground=True))
        return done

    def _radius_m(self, request: Request) -> float:
        """Radius of the circle, negative anticlockwise; 0 for the default."""
        anticlockwise = not math.isnan(request.param4) and request.param4 != 0.0
        radius_m = request.param3 if request.param3 > 0.0 else 0.0
        if not anticlockwise:
            return radius_m
        return -(radius_m or abs(self._vehicle.parameters["WP_LOITER_RAD"]))


def _flags(value: float) -> int:
    return 0 if math.isnan(value) else int(value)
