"""Reading and setting the parameters of a vehicle: PARAM_REQUEST_LIST, PARAM_REQUEST_READ, PARAM_SET."""

from collections.abc import Callable
from typing import NamedTuple

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from gcs.transfers.acquaintance import Acquaintance
from gcs.transfers.errors import TransferError
from gcs.transfers.run import run
from gcs.transfers.transfer import Transfer
from gcs.vehicle_link import VehicleLink
from missions.mission import as_float32
from sitl.services.peer import Message

WINDOW = 32
"""Missing parameters asked for at a time."""
STARTS = 5
"""How often a fetch begins, at most: anew each time that the vehicle has another number of parameters."""
_REFUSALS = 2
"""A vehicle that answers a PARAM_SET so often with another value does not take it; the first may be a late word."""


class ParameterValue(NamedTuple):
    """A parameter's value and its MAV_PARAM_TYPE."""

    value: float
    kind: int


class ParameterFetch(Transfer[dict[str, ParameterValue]]):
    """Fetches all parameters of one vehicle: the list once, and then by index what is missing of it.

    Args:
        sysid, compid, send, now, known: as of Transfer.
    """

    def __init__(
        self,
        sysid: int,
        compid: int,
        send: Callable[[Message], None],
        now: Callable[[], float],
        known: Acquaintance | None = None,
    ) -> None:
        super().__init__(sysid, compid, send, now, known)
        self._count: int | None = None
        self._starts = 0
        self._found: dict[int, tuple[str, ParameterValue]] = {}

    def start(self) -> None:
        """Ask for the list."""
        self._ask(mavlink.MAVLink_param_request_list_message(*self._target))

    def _take(self, message: Message) -> None:
        if message.get_type() != "PARAM_VALUE" or message.param_index >= message.param_count:
            return
        if message.param_count != self._count:  # the first, or the vehicle has been restarted with others
            self._starts += 1
            if self._starts > STARTS:
                self.outcome = self._error(f"says {self._count} parameters, and then {message.param_count}")
                return
            self._count = int(message.param_count)
            self._found = {}
        if message.param_index in self._found:
            return
        if self._found or self._starts > 1:
            self._heard(message)
            self._progress()
        else:
            self._answered(message)
        value = ParameterValue(message.param_value, message.param_type)
        self._found[message.param_index] = (message.param_id.rstrip("\0"), value)
        self._set_deadline()
        if len(self._found) == self._count:
            self.outcome = dict(sorted(self._found.values()))

    def _repeat(self) -> None:
        if self._count is None:
            self._send(self._waiting)
        else:
            missing = [index for index in range(self._count) if index not in self._found]
            for index in missing[:WINDOW]:
                self._send(mavlink.MAVLink_param_request_read_message(*self._target, b"", index))
        self._set_deadline()

    def _give_up(self) -> "dict[str, ParameterValue] | TransferError":
        got = f"{len(self._found)} of {self._count}" if self._count is not None else "none"
        return self._error(f"parameters stopped, {got} received: no answer; check the link and try again")


class ParameterRead(Transfer[ParameterValue]):
    """Reads one parameter by its name; a vehicle does not answer for one that it does not have.

    Args:
        name: of the parameter.
        sysid, compid, send, now, known: as of Transfer.
    """

    stuck_s = 5.0

    def __init__(
        self,
        name: str,
        sysid: int,
        compid: int,
        send: Callable[[Message], None],
        now: Callable[[], float],
        known: Acquaintance | None = None,
    ) -> None:
        super().__init__(sysid, compid, send, now, known)
        self._name = name.upper()

    def start(self) -> None:
        """Ask for it."""
        self._ask(mavlink.MAVLink_param_request_read_message(*self._target, self._name.encode(), -1))

    def _take(self, message: Message) -> None:
        kind = message.get_type()
        if kind not in ("PARAM_VALUE", "PARAM_ERROR") or message.param_id.rstrip("\0").upper() != self._name:
            return
        if kind == "PARAM_VALUE":
            self._answered(message)
            self._take_value(ParameterValue(message.param_value, message.param_type))
            return
        self._heard(message)
        if message.error == mavlink.MAV_PARAM_ERROR_DOES_NOT_EXIST:
            self.outcome = self._error(f"has no parameter {self._name}")
        else:
            entry = mavlink.enums["MAV_PARAM_ERROR"].get(message.error)
            reason = entry.name if entry is not None else f"error {message.error}"
            self.outcome = self._error(f"parameter {self._name} refused with {reason}")

    def _take_value(self, value: ParameterValue) -> None:
        self.outcome = value

    def _give_up(self) -> "ParameterValue | TransferError":
        return self._error(f"no answer for parameter {self._name}; it may not have one of that name")


class ParameterSet(ParameterRead):
    """Sets one parameter; done when the vehicle says that it holds the value.

    Args:
        name: of the parameter.
        wanted: the value, and the type that it has on the vehicle.
        sysid, compid, send, now, known: as of Transfer.
    """

    def __init__(
        self,
        name: str,
        wanted: ParameterValue,
        sysid: int,
        compid: int,
        send: Callable[[Message], None],
        now: Callable[[], float],
        known: Acquaintance | None = None,
    ) -> None:
        super().__init__(name, sysid, compid, send, now, known)
        self._wanted = wanted
        self._others = 0

    def start(self) -> None:
        """Set it."""
        value, kind = self._wanted
        self._ask(mavlink.MAVLink_param_set_message(*self._target, self._name.encode(), value, kind))

    def _take_value(self, value: ParameterValue) -> None:
        if value.value == as_float32(self._wanted.value):
            self.outcome = value
            return
        self._others += 1
        if self._others >= _REFUSALS:
            self.outcome = self._error(f"{self._name} stays {value.value:g}, wanted {self._wanted.value:g}")
        else:
            self._send(self._waiting)
            self._set_deadline()


async def fetch_parameters(vehicle: VehicleLink) -> dict[str, ParameterValue]:
    """All parameters of a vehicle by name. Raises TransferError."""
    async with vehicle.transfer_lock:
        return await run(vehicle, lambda *link: ParameterFetch(*link))


async def read_parameter(vehicle: VehicleLink, name: str) -> ParameterValue:
    """One parameter. Raises TransferError when the vehicle does not answer for it."""
    async with vehicle.transfer_lock:
        return await run(vehicle, lambda *link: ParameterRead(name, *link))


async def set_parameter(vehicle: VehicleLink, name: str, value: float) -> ParameterValue:
    """Set one parameter; its type is the one that it has on the vehicle. Raises TransferError when it is not taken."""
    kind = (await read_parameter(vehicle, name)).kind
    async with vehicle.transfer_lock:
        return await run(vehicle, lambda *link: ParameterSet(name, ParameterValue(value, kind), *link))
