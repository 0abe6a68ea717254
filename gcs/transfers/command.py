"""Commands to a vehicle: COMMAND_LONG or COMMAND_INT, repeated until the COMMAND_ACK comes."""

from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.flight_modes import mode_params
from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.errors import TransferError
from gcs.transfers.run import run
from gcs.transfers.transfer import Transfer
from gcs.vehicle_link import VehicleLink
from missions.errors import InputError
from missions.mission import MissionItem
from sitl.modes import Mode
from sitl.services.peer import Message

_PARAMS = 7
_FORCED = 21196.0
"""param2 of COMPONENT_ARM_DISARM: do it in any case."""
_PAUSE_S = 1.0
_REJECTED_S = 10.0
"""A command that is TEMPORARILY_REJECTED is tried again each second for so long."""


class Command(Transfer[int]):
    """One command; its outcome is the MAV_RESULT of the vehicle.

    A COMMAND_ACK that an earlier command of the same number has still to get is not taken for this one's; as a command
    may be repeated without harm, one that was done and whose answer was lost is done, and answered, once more.

    Args:
        message: the COMMAND_LONG or COMMAND_INT.
        sysid, compid, send, now, known: as of Transfer.
    """

    def __init__(
        self,
        message: Message,
        sysid: int,
        compid: int,
        send: Callable[[Message], None],
        now: Callable[[], float],
        known: Acquaintance | None = None,
    ) -> None:
        super().__init__(sysid, compid, send, now, known)
        self._message = message
        self._message.target_system, self._message.target_component = self._target
        self._late = self._known.unanswered.of(message.command, now())
        self._started_at_s = now()

    def start(self) -> None:
        """Send the command."""
        self._known.unanswered.sent(self._message.command, self._now())
        self._ask(self._message)

    def _repeat(self) -> None:
        """Send the command again, counting in `confirmation`."""
        if self._message.get_type() == "COMMAND_LONG":
            self._message.confirmation = min(self._tries, 255)
        self._known.unanswered.sent(self._message.command, self._now())
        super()._repeat()

    def _take(self, message: Message) -> None:
        if message.get_type() != "COMMAND_ACK" or message.command != self._message.command:
            return
        self._heard(message)
        if message.result == mavlink.MAV_RESULT_IN_PROGRESS:
            self._progress()
            self._set_deadline()
            return
        self._known.unanswered.answered(message.command)
        if self._late > 0:
            self._late -= 1
            return
        rejected = message.result == mavlink.MAV_RESULT_TEMPORARILY_REJECTED
        if rejected and self._now() - self._started_at_s < _REJECTED_S:
            self.deadline_s = self._now() + _PAUSE_S
            return
        self._answered(message)
        self.outcome = int(message.result)

    def _give_up(self) -> "int | TransferError":
        return self._error(f"no answer to {_name(self._message.command)}; check the link and try again")


def command_long(number: int, *params: float) -> Message:
    """A COMMAND_LONG with the first of its seven parameters; the rest are 0."""
    return mavlink.MAVLink_command_long_message(0, 0, number, 0, *params, *(0.0,) * (_PARAMS - len(params)))


def command_int(item: MissionItem) -> Message:
    """A COMMAND_INT that does what an item says: its command, frame, parameters and position."""
    place = (item.lat_e7, item.lon_e7, item.alt_m)
    return mavlink.MAVLink_command_int_message(0, 0, item.frame, item.command, 0, 0, *item.params, *place)


async def send_command(vehicle: VehicleLink, message: Message) -> int:
    """Send a command made by `command_long` or `command_int`; returns its MAV_RESULT.

    Commands do not wait for a plan's transfer; they do for one another.

    Raises:
        TransferError: no answer comes.
    """
    async with vehicle.command_lock:
        return await run(vehicle, lambda *link: Command(message, *link))


async def command(vehicle: VehicleLink, number: int, *params: float) -> int:
    """Send a COMMAND_LONG; returns its MAV_RESULT, raises TransferError when no answer comes."""
    return await send_command(vehicle, command_long(number, *params))


async def must(vehicle: VehicleLink, what: str, message: Message) -> None:
    """Send a command; raises TransferError, with the vehicle's reason, unless it is accepted.

    Args:
        vehicle: who is told.
        what: what is wanted, for people.
        message: made by `command_long` or `command_int`.
    """
    said = len(vehicle.texts)
    result = await send_command(vehicle, message)
    if result != mavlink.MAV_RESULT_ACCEPTED:
        entry = mavlink.enums["MAV_RESULT"].get(result)
        name = entry.name if entry is not None else f"result {result}"
        reason = "; ".join(dict.fromkeys(vehicle.texts[said:]))
        raise TransferError(f"{vehicle}: {what} refused with {name}" + (f": {reason}" if reason else ""))


async def arm(vehicle: VehicleLink, *, force: bool = False) -> None:
    """Arm, by force whatever its checks say; raises TransferError with the vehicle's reason when it refuses."""
    await must(vehicle, "arming", command_long(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1.0, _FORCED if force else 0.0))


async def disarm(vehicle: VehicleLink, *, force: bool = False) -> None:
    """Disarm, by force in flight too; raises TransferError with the vehicle's reason when it refuses."""
    await must(vehicle, "disarming", command_long(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 0.0, _FORCED if force else 0.0))


async def set_mode(vehicle: VehicleLink, mode: Mode) -> None:
    """Change to a mode; raises TransferError with the vehicle's reason when it refuses."""
    try:
        params = mode_params(mode, vehicle.autopilot)
    except InputError as error:
        raise TransferError(f"{vehicle}: {error}") from None
    custom = float(mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED)
    await must(vehicle, f"mode {mode.name}", command_long(mavlink.MAV_CMD_DO_SET_MODE, custom, *params))


def _name(number: int) -> str:
    entry = mavlink.enums["MAV_CMD"].get(number)
    return entry.name if entry is not None else f"command {number}"
