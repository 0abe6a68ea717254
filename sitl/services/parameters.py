"""The parameter protocol: list, read, set."""

from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.errors import InputError
from sitl.events import StatusText
from sitl.parameters import Parameters
from sitl.services.peer import Message, Peer, Send, Station

PER_TICK = 20
"""Parameters of a list sent at each tick, so that a long list does not flood a radio link."""

_NO_INDEX = 0xFFFF


class ParameterServer:
    """Serves a vehicle's parameters; values are sent as floats (PARAM_ENCODE_C_CAST), as ArduPilot does.

    Args:
        parameters: served in the order of their names.
        send: puts a message on the wire to a peer.
        report: called with the StatusText that explains a refusal.
    """

    def __init__(self, parameters: Parameters, send: Send, report: Callable[[StatusText], None]) -> None:
        self._parameters = parameters
        self._names = parameters.names
        self._send = send
        self._report = report
        self._next_of_list: dict[Station, int] = {}

    def on_message(self, message: Message, peer: Peer) -> None:
        """Take PARAM_REQUEST_LIST, PARAM_REQUEST_READ or PARAM_SET; unknown names and indices get silence."""
        kind = message.get_type()
        if kind == "PARAM_REQUEST_LIST":
            self._next_of_list[Station.of(message, peer)] = 0
        elif kind == "PARAM_REQUEST_READ":
            name = message.param_id.upper() if message.param_index < 0 else self._name_at(message.param_index)
            if name in self._parameters:
                self._send_value(name, self._names.index(name), peer)
        elif kind == "PARAM_SET" and message.param_id.upper() in self._parameters:
            name = message.param_id.upper()
            try:
                self._parameters.set(name, message.param_value)
            except InputError as error:
                self._report(StatusText(mavlink.MAV_SEVERITY_WARNING, str(error)))
            self._send_value(name, _NO_INDEX, peer)

    def on_tick(self) -> None:
        """Send the next part of each list asked for."""
        for station, start in list(self._next_of_list.items()):
            end = min(start + PER_TICK, len(self._names))
            for index in range(start, end):
                self._send_value(self._names[index], index, station.peer)
            if end == len(self._names):
                del self._next_of_list[station]
            else:
                self._next_of_list[station] = end

    def forget(self, peer: Peer) -> None:
        """A peer is gone: its lists with it."""
        self._next_of_list = {station: at for station, at in self._next_of_list.items() if station.peer != peer}

    def _name_at(self, index: int) -> str:
        return self._names[index] if index < len(self._names) else ""

    def _send_value(self, name: str, index: int, peer: Peer) -> None:
        value, kind = self._parameters[name], self._parameters.kind(name)
        message = mavlink.MAVLink_param_value_message(name.encode(), value, kind, len(self._names), index)
        self._send(message, peer)
