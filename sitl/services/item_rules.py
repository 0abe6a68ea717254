"""What the items of a plan may say, command by command, and the MAV_MISSION_RESULT for what they may not."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.commands import Command, Frame
from missions.mission import MissionItem
from missions.plan_type import PlanType

LARGEST_ALTITUDE_M = 83_000.0
"""ArduPilot's LOCATION_ALT_MAX_M."""

_MOST_JUMPS = 32767

POSITION_FRAMES = frozenset({Frame.GLOBAL, Frame.GLOBAL_RELATIVE_ALT, Frame.GLOBAL_INT, Frame.GLOBAL_RELATIVE_ALT_INT})


@dataclass(frozen=True)
class Refusal:
    """Why an item or a plan is not taken.

    Attributes:
        result: the MAV_MISSION_RESULT.
        reason: in words.
    """

    result: int
    reason: str


Check = Callable[[float], bool]


def _not_negative(value: float) -> bool:
    return 0.0 <= value < math.inf


def _positive(value: float) -> bool:
    return 0.0 < value < math.inf


def _number(value: float) -> bool:
    return math.isfinite(value)


def _unused(value: float) -> bool:
    """NaN stands for the default."""
    return not math.isinf(value)


def _speed_type(value: float) -> bool:
    """Airspeed or ground speed."""
    return value in (0.0, 1.0)


def _speed(value: float) -> bool:
    """Metres a second, -1 for no change, -2 for the default."""
    return _positive(value) or value in (-1.0, -2.0)


def _repeats(value: float) -> bool:
    """A number of times, -1 for ever."""
    return value.is_integer() and -1 <= value <= _MOST_JUMPS


@dataclass(frozen=True)
class _Rule:
    """What one command demands of its parameters 1 to 4, and whether its item is a place."""

    place: bool
    params: tuple[Check, Check, Check, Check]


_RULES = {
    PlanType.MISSION: {
        Command.NAV_WAYPOINT: _Rule(True, (_not_negative, _not_negative, _number, _unused)),
        Command.NAV_LOITER_UNLIM: _Rule(True, (_unused, _unused, _number, _unused)),
        Command.NAV_LOITER_TURNS: _Rule(True, (_positive, _unused, _number, _unused)),
        Command.NAV_LOITER_TIME: _Rule(True, (_not_negative, _unused, _number, _unused)),
        Command.NAV_LOITER_TO_ALT: _Rule(True, (_unused, _number, _unused, _unused)),
        Command.NAV_RETURN_TO_LAUNCH: _Rule(False, (_unused, _unused, _unused, _unused)),
        Command.NAV_LAND: _Rule(True, (_number, _unused, _unused, _unused)),
        Command.NAV_TAKEOFF: _Rule(True, (_number, _unused, _unused, _unused)),
        Command.DO_JUMP: _Rule(False, (_number, _repeats, _unused, _unused)),
        Command.DO_CHANGE_SPEED: _Rule(False, (_speed_type, _speed, _number, _unused)),
        Command.DO_LAND_START: _Rule(False, (_unused, _unused, _unused, _unused)),
    },
    PlanType.FENCE: {
        command: _Rule(True, (lambda _: True, _unused, _unused, _unused))  # param1 is judged with the whole fence
        for command in (
            Command.NAV_FENCE_RETURN_POINT,
            Command.NAV_FENCE_POLYGON_VERTEX_INCLUSION,
            Command.NAV_FENCE_POLYGON_VERTEX_EXCLUSION,
            Command.NAV_FENCE_CIRCLE_INCLUSION,
            Command.NAV_FENCE_CIRCLE_EXCLUSION,
        )
    },
    PlanType.RALLY: {Command.NAV_RALLY_POINT: _Rule(True, (_unused, _unused, _unused, _unused))},
}


def command_name(command: int) -> str:
    """A MAV_CMD by name and number."""
    entry = mavlink.enums["MAV_CMD"].get(command)
    return f"command {command}" if entry is None else f"{entry.name.removeprefix('MAV_CMD_')} ({command})"


def refusal(item: MissionItem, plan: PlanType, count: int) -> Refusal | None:
    """What is wrong with an item of a plan of `count` items; None for nothing."""
    rule = _RULES[plan].get(item.command)  # type: ignore[call-overload]
    name = command_name(item.command)
    if rule is None:
        return Refusal(mavlink.MAV_MISSION_UNSUPPORTED, f"{name} is not for a {plan.name.lower()} here")
    if item.frame not in POSITION_FRAMES and (rule.place or item.frame != Frame.MISSION):
        return Refusal(mavlink.MAV_MISSION_UNSUPPORTED_FRAME, f"{name} in frame {item.frame}; use 0 or 3")
    for number, (value, fits) in enumerate(zip(item.params, rule.params, strict=True), start=1):
        if not fits(value):
            return invalid(number, f"{name} param{number} = {value:g}")
    if rule.place:
        return _misplaced(item, name)
    if item.command == Command.DO_JUMP and not (item.param1.is_integer() and 1 <= item.param1 < count):
        return invalid(1, f"DO_JUMP to item {item.param1:g}; there are 1 to {count - 1}")
    return None


def is_place(command: int, plan: PlanType) -> bool:
    """Whether the item of this command is a place; of others the position means nothing."""
    rule = _RULES[plan].get(command)  # type: ignore[call-overload]
    return rule is not None and rule.place


def invalid(param: int, reason: str) -> Refusal:
    """The refusal of parameter 1 to 7."""
    return Refusal(mavlink.MAV_MISSION_INVALID_PARAM1 + param - 1, reason)


def _misplaced(item: MissionItem, name: str) -> Refusal | None:
    if abs(item.lat_e7) > 90 * 10**7:
        return invalid(5, f"{name} latitude {item.lat_deg:g}")
    if abs(item.lon_e7) > 180 * 10**7:
        return invalid(6, f"{name} longitude {item.lon_deg:g}")
    if not abs(item.alt_m) <= LARGEST_ALTITUDE_M:  # NaN included
        return invalid(7, f"{name} altitude {item.alt_m:g} m")
    return None
