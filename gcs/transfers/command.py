"""Commands to a vehicle: COMMAND_LONG, repeated until its COMMAND_ACK comes."""

from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.errors import TransferError
from gcs.transfers.run import run
from gcs.transfers.transfer import Transfer
from gcs.vehicle_link import VehicleLink
from sitl.services.peer import Message

_PARAMS = 7


class Command(Transfer[int]):
    """One command; its outcome is the MAV_RESULT of the vehicle.

    Args:
        command: MAV_CMD number.
        params: the first of the seven parameters; the rest are 0.
        sysid, compid, send, now: as of Transfer.
    """

    def __init__(
        self,
        command: int,
        params: tuple[float, ...],
        sysid: int,
        compid: int,
        send: Callable[[Message], None],
        now: Callable[[], float],
    ) -> None:
        super().__init__(sysid, compid, send, now)
        self._command = command
        self._params = params + (0.0,) * (_PARAMS - len(params))

    def start(self) -> None:
        """Send the command."""
        self._ask(mavlink.MAVLink_command_long_message(*self._target, self._command, 0, *self._params))

    def on_tick(self) -> None:
        """Repeat the command, counting in `confirmation`, or give up."""
        if self._waiting is not None:
            self._waiting.confirmation = self._tries + 1
        super().on_tick()

    def _take(self, message: Message) -> None:
        if message.get_type() != "COMMAND_ACK" or message.command != self._command:
            return
        self._answered(message)
        if message.result == mavlink.MAV_RESULT_IN_PROGRESS:
            self._tries = 0
            self._set_deadline()
        else:
            self.outcome = int(message.result)

    def _give_up(self) -> "int | TransferError":
        return self._error(f"no answer to {_name(self._command)}; check the link and try again")


async def command(vehicle: VehicleLink, number: int, *params: float) -> int:
    """Send a command; returns its MAV_RESULT, raises TransferError when no answer comes."""
    return await run(vehicle, lambda send, now: Command(number, params, vehicle.sysid, vehicle.compid, send, now))


async def arm(vehicle: VehicleLink) -> None:
    """Arm; raises TransferError with the vehicle's reason when it refuses."""
    await _must(vehicle, "arming", mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1.0)


async def disarm(vehicle: VehicleLink) -> None:
    """Disarm; raises TransferError with the vehicle's reason when it refuses."""
    await _must(vehicle, "disarming", mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 0.0)


async def set_mode(vehicle: VehicleLink, custom_mode: int) -> None:
    """Change to a mode of ArduPlane's numbering; raises TransferError with the vehicle's reason when it refuses."""
    custom = float(mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED)
    await _must(vehicle, f"mode {custom_mode}", mavlink.MAV_CMD_DO_SET_MODE, custom, float(custom_mode))


async def _must(vehicle: VehicleLink, what: str, number: int, *params: float) -> None:
    said = len(vehicle.texts)
    result = await command(vehicle, number, *params)
    if result != mavlink.MAV_RESULT_ACCEPTED:
        entry = mavlink.enums["MAV_RESULT"].get(result)
        name = entry.name if entry is not None else f"result {result}"
        reason = "; ".join(vehicle.texts[said:])
        raise TransferError(f"{vehicle}: {what} refused with {name}" + (f": {reason}" if reason else ""))


def _name(number: int) -> str:
    entry = mavlink.enums["MAV_CMD"].get(number)
    return entry.name if entry is not None else f"command {number}"
