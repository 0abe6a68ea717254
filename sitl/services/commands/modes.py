"""Changing the flight mode."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.modes import Mode
from sitl.services.commands.request import Answer, Handler, Request, denied, failed, outcome, whole_number
from sitl.services.stream_messages.modes import STANDARD_MODES
from sitl.services.vehicle import Vehicle

_KNOWN = ", ".join(f"{mode.name} {mode.value}" for mode in Mode)
_BY_STANDARD = {standard: mode for mode, standard in STANDARD_MODES.items()}


class ModeCommands:
    """DO_SET_MODE, DO_SET_STANDARD_MODE, and the commands that are ArduPlane's names of a mode."""

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle
        self.handlers: dict[int, Handler] = {
            mavlink.MAV_CMD_DO_SET_MODE: self._do_set_mode,
            mavlink.MAV_CMD_DO_SET_STANDARD_MODE: self._do_set_standard_mode,
            mavlink.MAV_CMD_NAV_LOITER_UNLIM: lambda request: outcome(vehicle.set_mode(Mode.LOITER)),
            mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH: lambda request: outcome(vehicle.set_mode(Mode.RTL)),
        }

    def set_mode(self, base_mode: int, custom_mode: int) -> Answer:
        """Change to one of ArduPlane's modes, which the custom flag of `base_mode` announces."""
        if not base_mode & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED:
            return denied()
        try:
            mode = Mode(custom_mode)
        except ValueError:
            return failed(f"No mode {custom_mode}: there are {_KNOWN}")
        return outcome(self._vehicle.set_mode(mode))

    def _do_set_mode(self, request: Request) -> Answer:
        base_mode, custom_mode = whole_number(request.param1), whole_number(request.param2)
        if base_mode is None or custom_mode is None:
            return denied()
        return self.set_mode(base_mode, custom_mode)

    def _do_set_standard_mode(self, request: Request) -> Answer:
        mode = _BY_STANDARD.get(whole_number(request.param1) or 0)
        return outcome(self._vehicle.set_mode(mode)) if mode is not None else denied()
