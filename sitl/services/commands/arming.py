"""Arming and disarming."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.commands.request import ACCEPTED, NOT_NOW, Answer, Handler, Request, denied, outcome
from sitl.services.vehicle import Vehicle

_BY_FORCE = (21196.0, 2989.0)
"""MAVLink's number, and the one that ArduPilot's stations send."""


class ArmingCommands:
    """COMPONENT_ARM_DISARM and RUN_PREARM_CHECKS."""

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle
        self.handlers: dict[int, Handler] = {
            mavlink.MAV_CMD_COMPONENT_ARM_DISARM: self._arm_or_disarm,
            mavlink.MAV_CMD_RUN_PREARM_CHECKS: self._run_checks,
        }

    def _arm_or_disarm(self, request: Request) -> Answer:
        force = request.param2 in _BY_FORCE
        if request.param1 == 1:
            return outcome(self._vehicle.arm(force=force))
        if request.param1 == 0:
            return outcome(self._vehicle.disarm(force=force))
        return denied()

    def _run_checks(self, request: Request) -> Answer:
        """The result says that the checks were run; the reason, what they found."""
        if self._vehicle.snapshot().armed:
            return NOT_NOW
        return Answer(ACCEPTED.result, self._vehicle.prearm())
