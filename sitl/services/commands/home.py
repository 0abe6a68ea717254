"""Changing where the vehicle returns to."""

from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.commands import Command, Frame
from missions.mission import MissionItem
from sitl.services.commands.place import place_of
from sitl.services.commands.request import Answer, Handler, Request, denied, outcome
from sitl.services.stream_messages.view import View
from sitl.services.vehicle import Vehicle


class HomeCommands:
    """DO_SET_HOME.

    Args:
        vehicle: whose home it is.
        view: gives where it is.
    """

    def __init__(self, vehicle: Vehicle, view: Callable[[], View]) -> None:
        self._vehicle = vehicle
        self._view = view
        self.handlers: dict[int, Handler] = {mavlink.MAV_CMD_DO_SET_HOME: self._set_home}

    def _set_home(self, request: Request) -> Answer:
        """Home is where the vehicle is (param1 = 1, or no position), or where params 5 to 7 say."""
        if request.param1 == 1:
            return outcome(self._vehicle.set_home(None))
        if request.param1 != 0:
            return denied()
        if (request.lat_e7, request.lon_e7) == (0, 0):
            return outcome(self._vehicle.set_home(None))
        place = place_of(request, self._view())
        if isinstance(place, Answer):
            return place
        lat_e7, lon_e7, altitude_m = place
        home = MissionItem(Command.NAV_WAYPOINT, Frame.GLOBAL, lat_e7=lat_e7, lon_e7=lon_e7, alt_m=altitude_m)
        return outcome(self._vehicle.set_home(home))
