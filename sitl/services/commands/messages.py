"""Asking for messages: once, or at an interval."""

from collections.abc import Callable, Sequence

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.autopilot_version import autopilot_version
from sitl.services.commands.request import ACCEPTED, Answer, Handler, Request, denied, failed, whole_number
from sitl.services.mode_messages import AvailableModes
from sitl.services.peer import Message, Send
from sitl.services.stream_messages.modes import available_modes
from sitl.services.stream_messages.streams import STREAMS
from sitl.services.stream_messages.view import View
from sitl.services.telemetry import Telemetry
from sitl.services.vehicle import Vehicle


class MessageCommands:
    """REQUEST_MESSAGE, SET_ and GET_MESSAGE_INTERVAL, and the old requests for one message each.

    Args:
        vehicle: whose messages they are.
        telemetry: whose intervals are set.
        view: gives the state that a message is made from.
        send: puts a message on the wire to a peer.
    """

    def __init__(self, vehicle: Vehicle, telemetry: Telemetry, view: Callable[[], View], send: Send) -> None:
        self._vehicle = vehicle
        self._telemetry = telemetry
        self._view = view
        self._send = send
        self.handlers: dict[int, Handler] = {
            mavlink.MAV_CMD_REQUEST_MESSAGE: self._request,
            mavlink.MAV_CMD_SET_MESSAGE_INTERVAL: self._set_interval,
            mavlink.MAV_CMD_GET_MESSAGE_INTERVAL: self._get_interval,
            mavlink.MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES: self._request_capabilities,
            mavlink.MAV_CMD_GET_HOME_POSITION: self._get_home_position,
        }

    def _request(self, request: Request) -> Answer:
        return self._answer(request, self._messages(request.param1, request.param2))

    def _request_capabilities(self, request: Request) -> Answer:
        if request.param1 != 1:
            return denied()
        return self._answer(request, self._messages(mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION))

    def _get_home_position(self, request: Request) -> Answer:
        return self._answer(request, self._messages(mavlink.MAVLINK_MSG_ID_HOME_POSITION))

    def _answer(self, request: Request, messages: Sequence[Message]) -> Answer:
        for message in messages:
            self._send(message, request.peer)
        return ACCEPTED if messages else failed()

    def _messages(self, message_id: float, index: float = 0.0) -> Sequence[Message]:
        """What a request for this message is answered with; nothing when there is none such."""
        if message_id == mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION:
            return (autopilot_version(self._vehicle.sysid),)
        if message_id == AvailableModes.id:
            mode_index = whole_number(index)
            return () if mode_index is None else available_modes(mode_index)
        return STREAMS[int(message_id)].messages(self._view()) if message_id in STREAMS else ()

    def _set_interval(self, request: Request) -> Answer:
        return ACCEPTED if self._telemetry.set_interval_us(request.peer, request.param1, request.param2) else denied()

    def _get_interval(self, request: Request) -> Answer:
        interval_us = self._telemetry.interval_us(request.peer, request.param1)
        if interval_us is None:
            return failed()
        self._send(mavlink.MAVLink_message_interval_message(int(request.param1), interval_us), request.peer)
        return ACCEPTED
