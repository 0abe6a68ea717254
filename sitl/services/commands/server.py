"""COMMAND_LONG and COMMAND_INT, answered by COMMAND_ACK; and the old messages that are commands by another name."""

from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.events import StatusText
from sitl.services.commands.arming import ArmingCommands
from sitl.services.commands.fence import FenceCommands
from sitl.services.commands.home import HomeCommands
from sitl.services.commands.messages import MessageCommands
from sitl.services.commands.mission import MissionCommands
from sitl.services.commands.modes import ModeCommands
from sitl.services.commands.motion import MotionCommands
from sitl.services.commands.request import UNSUPPORTED, Answer, Handler, Request
from sitl.services.peer import Message, Peer, Send
from sitl.services.stream_messages.view import View
from sitl.services.telemetry import Telemetry
from sitl.services.vehicle import Vehicle


class CommandServer:
    """Carries out commands to one vehicle. Every command may be repeated without harm.

    Args:
        vehicle: who obeys.
        telemetry: whose intervals can be set.
        view: gives the state that requested messages are made from, and where the vehicle is.
        send: puts a message on the wire to a peer.
        report: called with each StatusText that explains a refusal.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        telemetry: Telemetry,
        view: Callable[[], View],
        send: Send,
        report: Callable[[StatusText], None],
    ) -> None:
        self._telemetry = telemetry
        self._send = send
        self._report = report
        self._modes = ModeCommands(vehicle)
        self._mission = MissionCommands(vehicle)
        self._handlers: dict[int, Handler] = {
            **ArmingCommands(vehicle).handlers,
            **self._modes.handlers,
            **self._mission.handlers,
            **MotionCommands(vehicle, view).handlers,
            **HomeCommands(vehicle, view).handlers,
            **FenceCommands(vehicle).handlers,
            **MessageCommands(vehicle, telemetry, view, send).handlers,
        }

    def on_message(self, message: Message, peer: Peer) -> None:
        """Take COMMAND_LONG, COMMAND_INT, or the old SET_MODE, MISSION_SET_CURRENT or REQUEST_DATA_STREAM."""
        match message.get_type():
            case "COMMAND_LONG" | "COMMAND_INT":
                handler = self._handlers.get(message.command)
                answer = handler(Request.of(message, peer)) if handler else UNSUPPORTED
                self._explain(answer)
                station = (message.get_srcSystem(), message.get_srcComponent())
                ack = mavlink.MAVLink_command_ack_message(message.command, answer.result, 0, 0, *station)
                self._send(ack, peer)
            case "SET_MODE":
                self._explain(self._modes.set_mode(message.base_mode, message.custom_mode))
            case "MISSION_SET_CURRENT":
                self._explain(self._mission.set_current(message.seq))
            case "REQUEST_DATA_STREAM":
                rate_hz = message.req_message_rate if message.start_stop else 0
                self._telemetry.request_group(peer, message.req_stream_id, rate_hz)

    def _explain(self, answer: Answer) -> None:
        if answer.reason is not None:
            self._report(StatusText(mavlink.MAV_SEVERITY_WARNING, answer.reason))
