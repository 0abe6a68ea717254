"""Heeding the fence, or not."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.commands.request import Answer, Handler, Request, denied, outcome
from sitl.services.vehicle import Vehicle


class FenceCommands:
    """DO_FENCE_ENABLE."""

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle
        self.handlers: dict[int, Handler] = {mavlink.MAV_CMD_DO_FENCE_ENABLE: self._enable}

    def _enable(self, request: Request) -> Answer:
        """All fences (param1 = 1) or none (0); single ones, by param1 = 2 or param2, cannot be switched."""
        if request.param1 not in (0, 1) or request.param2 > 0:
            return denied("DO_FENCE_ENABLE takes 0 or 1, for all fences together")
        return outcome(self._vehicle.enable_fence(request.param1 == 1))
