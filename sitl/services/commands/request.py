"""One command as it was asked, and how it is answered."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.commands import Frame
from missions.mission import degrees_to_e7
from sitl.services.peer import Message, Peer

UNCHANGED_E7 = 2**31 - 1
"""INT32_MAX, for a coordinate that is to stay as it is."""

_FAR_DEG = 1000.0
"""Beyond any angle that is a place."""


@dataclass(frozen=True)
class Request:
    """A COMMAND_INT, or a COMMAND_LONG.

    Attributes:
        peer: who asked.
        command: MAV_CMD number.
        param1, param2, param3, param4: as sent, NaN and infinities too.
        lat_e7, lon_e7: params 5 and 6 as a position in 1e-7 degrees; `UNCHANGED_E7` for NaN degrees.
        z_m: param 7.
        frame: MAV_FRAME that z_m is in; a COMMAND_LONG has none and gets GLOBAL.
        whole: params 5 and 6 came as whole numbers, so that a position in them is exact (COMMAND_INT).
    """

    peer: Peer
    command: int
    param1: float
    param2: float
    param3: float
    param4: float
    lat_e7: int
    lon_e7: int
    z_m: float
    frame: int
    whole: bool

    @classmethod
    def of(cls, message: Message, peer: Peer) -> "Request":
        """What a COMMAND_INT or COMMAND_LONG asks."""
        params = (message.param1, message.param2, message.param3, message.param4)
        if message.get_type() == "COMMAND_INT":
            return cls(peer, message.command, *params, message.x, message.y, message.z, message.frame, True)
        lat_e7, lon_e7 = _angle_e7(message.param5), _angle_e7(message.param6)
        return cls(peer, message.command, *params, lat_e7, lon_e7, message.param7, int(Frame.GLOBAL), False)


@dataclass(frozen=True)
class Answer:
    """The result of a command.

    Attributes:
        result: MAV_RESULT.
        reason: why it was refused, for the person at the station; None when the result says it all.
    """

    result: int
    reason: str | None = None


Handler: TypeAlias = Callable[[Request], Answer]
"""Carries out one kind of command."""

ACCEPTED = Answer(int(mavlink.MAV_RESULT_ACCEPTED))
UNSUPPORTED = Answer(int(mavlink.MAV_RESULT_UNSUPPORTED))
INT_ONLY = Answer(int(mavlink.MAV_RESULT_COMMAND_INT_ONLY))
NOT_NOW = Answer(int(mavlink.MAV_RESULT_TEMPORARILY_REJECTED))


def denied(reason: str | None = None) -> Answer:
    """The command cannot be meant so, now or ever."""
    return Answer(int(mavlink.MAV_RESULT_DENIED), reason)


def failed(reason: str | None = None) -> Answer:
    """It could have been done, and was not."""
    return Answer(int(mavlink.MAV_RESULT_FAILED), reason)


def outcome(reason: str | None) -> Answer:
    """What the vehicle made of it: done when it gives no reason why not."""
    return ACCEPTED if reason is None else failed(reason)


def whole_number(value: float) -> int | None:
    """A parameter that stands for a whole number; None when it is none."""
    return int(value) if math.isfinite(value) and value == math.floor(value) else None


def _angle_e7(angle_deg: float) -> int:
    if math.isnan(angle_deg):
        return UNCHANGED_E7
    return degrees_to_e7(max(-_FAR_DEG, min(_FAR_DEG, angle_deg)))
