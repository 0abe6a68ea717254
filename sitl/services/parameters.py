"""The parameter protocol: list, read, set."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.errors import InputError
from sitl.events import StatusText
from sitl.parameters import Parameters
from sitl.services.peer import Message, Peer, Send, Station

PER_PART = 36
PART_S = 0.02
"""A list is sent in parts of so many (one datagram), so long apart, lest it flood a radio link."""

_NO_INDEX = 0xFFFF


@dataclass
class _List:
    """A list that is being sent."""

    next_index: int
    due_at_s: float


class ParameterServer:
    """Serves a vehicle's parameters; values are sent as floats (PARAM_ENCODE_C_CAST), as ArduPilot does.

    Args:
        parameters: served in the order of their names.
        send: puts a message on the wire to a peer.
        broadcast: puts a message on the wire to every peer.
        report: called with the StatusText that explains a refusal.
        now: wall time in seconds; only differences matter.
    """

    def __init__(
        self,
        parameters: Parameters,
        send: Send,
        broadcast: Callable[[Message], None],
        report: Callable[[StatusText], None],
        now: Callable[[], float],
    ) -> None:
        self._parameters = parameters
        self._names = parameters.names
        self._send = send
        self._broadcast = broadcast
        self._report = report
        self._now = now
        self._lists: dict[Station, _List] = {}

    def on_message(self, message: Message, peer: Peer) -> None:
        """Take PARAM_REQUEST_LIST, PARAM_REQUEST_READ or PARAM_SET; of what there is none, PARAM_ERROR says so."""
        match message.get_type():
            case "PARAM_REQUEST_LIST":
                self._lists[Station.of(message, peer)] = _List(0, self._now())
                self.on_tick()
            case "PARAM_REQUEST_READ":
                name = message.param_id.upper() if message.param_index < 0 else self._name_at(message.param_index)
                if name in self._parameters:
                    self._send(self._value(name, self._parameters.index(name)), peer)
                else:
                    self._refuse_unknown(message, message.param_index, peer)
            case "PARAM_SET":
                name = message.param_id.upper()
                if name not in self._parameters:
                    self._refuse_unknown(message, -1, peer)
                elif not math.isnan(message.param_value):
                    self._set(name, message.param_value, peer)

    def on_tick(self) -> None:
        """Send the next part of each list that is due."""
        now_s = self._now()
        for station, started in list(self._lists.items()):
            if now_s < started.due_at_s:
                continue
            end = min(started.next_index + PER_PART, len(self._names))
            for index in range(started.next_index, end):
                self._send(self._value(self._names[index], index), station.peer)
            started.next_index, started.due_at_s = end, now_s + PART_S
            if end == len(self._names):
                del self._lists[station]

    def forget(self, peer: Peer) -> None:
        """A peer is gone: its lists with it."""
        self._lists = {station: started for station, started in self._lists.items() if station.peer != peer}

    def _set(self, name: str, value: float, peer: Peer) -> None:
        """Set it and tell everyone; who asks for what cannot be gets the old value, and the reason."""
        try:
            self._parameters.set(name, value)
        except InputError as error:
            self._report(StatusText(mavlink.MAV_SEVERITY_WARNING, str(error)))
            self._send(self._value(name, _NO_INDEX), peer)
            return
        for same in sorted(self._parameters.names_of(name), key=lambda same: same != name):
            self._broadcast(self._value(same, _NO_INDEX))

    def _refuse_unknown(self, message: Message, index: int, peer: Peer) -> None:
        """PARAM_ERROR spares a station that knows it the wait for an answer."""
        station = Station.of(message, peer)
        name = message.param_id.encode("ascii", "replace")
        error = mavlink.MAV_PARAM_ERROR_DOES_NOT_EXIST
        self._send(mavlink.MAVLink_param_error_message(station.sysid, station.compid, name, index, error), peer)

    def _name_at(self, index: int) -> str:
        return self._names[index] if index < len(self._names) else ""

    def _value(self, name: str, index: int) -> Message:
        value, kind = self._parameters[name], self._parameters.kind(name)
        return mavlink.MAVLink_param_value_message(name.encode(), value, kind, len(self._names), index)
