"""The command protocol: COMMAND_LONG and COMMAND_INT, answered by COMMAND_ACK; and the old SET_MODE."""

import math
from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.events import StatusText
from sitl.modes import Mode
from sitl.services.autopilot_version import autopilot_version
from sitl.services.peer import Message, Peer, Send
from sitl.services.stream_messages import BUILDERS, View
from sitl.services.telemetry import Telemetry
from sitl.services.vehicle import Vehicle

_ACCEPTED = int(mavlink.MAV_RESULT_ACCEPTED)
_DENIED = int(mavlink.MAV_RESULT_DENIED)
_UNSUPPORTED = int(mavlink.MAV_RESULT_UNSUPPORTED)
_FAILED = int(mavlink.MAV_RESULT_FAILED)


class CommandServer:
    """Carries out commands to one vehicle. Every command may be repeated without harm.

    Args:
        vehicle: who obeys.
        telemetry: whose intervals SET_MESSAGE_INTERVAL changes.
        view: gives the state that a requested message is made from.
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
        self._vehicle = vehicle
        self._telemetry = telemetry
        self._view = view
        self._send = send
        self._report = report
        self._commands: dict[int, Callable[[Message, Peer], int]] = {
            mavlink.MAV_CMD_COMPONENT_ARM_DISARM: self._arm_or_disarm,
            mavlink.MAV_CMD_DO_SET_MODE: self._do_set_mode,
            mavlink.MAV_CMD_MISSION_START: self._start_mission,
            mavlink.MAV_CMD_REQUEST_MESSAGE: self._request_message,
            mavlink.MAV_CMD_SET_MESSAGE_INTERVAL: self._set_message_interval,
            mavlink.MAV_CMD_GET_MESSAGE_INTERVAL: self._get_message_interval,
            mavlink.MAV_CMD_REQUEST_AUTOPILOT_CAPABILITIES: self._request_capabilities,
        }

    def on_message(self, message: Message, peer: Peer) -> None:
        """Take COMMAND_LONG, COMMAND_INT or SET_MODE."""
        kind = message.get_type()
        if kind in ("COMMAND_LONG", "COMMAND_INT"):
            command = self._commands.get(message.command)
            result = command(message, peer) if command else _UNSUPPORTED
            station = (message.get_srcSystem(), message.get_srcComponent())
            self._send(mavlink.MAVLink_command_ack_message(message.command, result, 0, 0, *station), peer)
        elif kind == "SET_MODE":
            self._set_mode(message.base_mode, message.custom_mode)

    def _arm_or_disarm(self, message: Message, peer: Peer) -> int:
        if message.param1 == 1:
            return self._outcome(self._vehicle.arm())
        if message.param1 == 0:
            return self._outcome(self._vehicle.disarm())
        return _DENIED

    def _do_set_mode(self, message: Message, peer: Peer) -> int:
        if not (math.isfinite(message.param1) and math.isfinite(message.param2)):
            return _DENIED
        return self._set_mode(int(message.param1), int(message.param2))

    def _set_mode(self, base_mode: int, custom_mode: int) -> int:
        if not base_mode & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED:
            return _DENIED
        try:
            mode = Mode(custom_mode)
        except ValueError:
            known = ", ".join(f"{mode.name} {mode.value}" for mode in Mode)
            return self._outcome(f"No mode {custom_mode}: there are {known}")
        return self._outcome(self._vehicle.set_mode(mode))

    def _start_mission(self, message: Message, peer: Peer) -> int:
        return self._outcome(self._vehicle.start_mission())

    def _request_message(self, message: Message, peer: Peer) -> int:
        if message.param1 == mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION:
            self._send(autopilot_version(self._vehicle.sysid), peer)
            return _ACCEPTED
        if message.param1 not in BUILDERS:
            return _FAILED
        self._send(BUILDERS[int(message.param1)](self._view()), peer)
        return _ACCEPTED

    def _set_message_interval(self, message: Message, peer: Peer) -> int:
        return _ACCEPTED if self._telemetry.set_interval_us(message.param1, message.param2) else _DENIED

    def _get_message_interval(self, message: Message, peer: Peer) -> int:
        interval_us = self._telemetry.interval_us(message.param1)
        if interval_us is None:
            return _FAILED
        self._send(mavlink.MAVLink_message_interval_message(int(message.param1), interval_us), peer)
        return _ACCEPTED

    def _request_capabilities(self, message: Message, peer: Peer) -> int:
        if message.param1 != 1:
            return _DENIED
        self._send(autopilot_version(self._vehicle.sysid), peer)
        return _ACCEPTED

    def _outcome(self, reason: str | None) -> int:
        if reason is None:
            return _ACCEPTED
        self._report(StatusText(mavlink.MAV_SEVERITY_WARNING, reason))
        return _FAILED
