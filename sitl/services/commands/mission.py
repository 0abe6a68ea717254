"""Starting the mission, and going on with another item of it."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.commands.request import Answer, Handler, Request, denied, outcome, whole_number
from sitl.services.vehicle import Vehicle


class MissionCommands:
    """MISSION_START and DO_SET_MISSION_CURRENT."""

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle
        self.handlers: dict[int, Handler] = {
            mavlink.MAV_CMD_MISSION_START: self._start,
            mavlink.MAV_CMD_DO_SET_MISSION_CURRENT: self._do_set_current,
        }

    def set_current(self, seq: int) -> Answer:
        """Go on with item `seq`."""
        if not 0 <= seq < len(self._vehicle.mission):
            return denied()
        return outcome(self._vehicle.set_current(seq))

    def _start(self, request: Request) -> Answer:
        """As ArduPlane: the whole mission or none."""
        if request.param1 or request.param2:
            return denied("MISSION_START of a part of the mission: there is only the whole")
        return outcome(self._vehicle.start_mission())

    def _do_set_current(self, request: Request) -> Answer:
        seq = whole_number(request.param1)
        return denied() if seq is None else self.set_current(seq)
