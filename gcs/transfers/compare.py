"""Comparing the plan that was sent with the one that the vehicle holds."""

import math
from collections.abc import Mapping, Sequence

from missions.autopilot import Autopilot
from missions.dialect import as_kept
from missions.mission import MissionItem
from missions.plan_type import PlanType

_POSITION_E7 = 2.0
_ALTITUDE_M = 0.01
_PARAM = 1e-3
_RALLY_ALTITUDE_M = 1.0
"""Autopilots pack what they store: 2 cm, 1 cm (ArduPilot keeps centimetres) and a thousandth are the same; of rally
points whole metres are kept."""

_POSITION = {"lat_e7": _POSITION_E7, "lon_e7": _POSITION_E7}

_TOLERANCES: Mapping[PlanType, Mapping[str, float]] = {
    PlanType.MISSION: {
        "command": 0.0,
        "frame": 0.0,
        "param1": _PARAM,
        "param2": _PARAM,
        "param3": _PARAM,
        "param4": _PARAM,
        **_POSITION,
        "alt_m": _ALTITUDE_M,
        "autocontinue": 0.0,
    },
    PlanType.FENCE: {"command": 0.0, "param1": _PARAM, **_POSITION},
    PlanType.RALLY: {"command": 0.0, "frame": 0.0, **_POSITION, "alt_m": _RALLY_ALTITUDE_M},
}
"""The fields that a plan of each type consists of, and how much they may differ."""


def differences(
    plan_type: PlanType,
    sent: Sequence[MissionItem],
    held: Sequence[MissionItem],
    autopilot: Autopilot = Autopilot.ardupilot,
) -> list[str]:
    """What differs, a line each, with item and field; empty when the vehicle holds what was sent.

    Item 0 of an ArduPilot's mission is the vehicle's own home, which replaces the one sent, and is not compared; nor is
    what an autopilot has no use for, and does not keep.
    """
    first = 1 if plan_type == PlanType.MISSION and autopilot.home_is_item_0 else 0
    lines = []
    if max(len(sent), first) != max(len(held), first):
        lines.append(f"{len(held)} items held, {len(sent)} sent")
    tolerances = _TOLERANCES[plan_type]
    for seq, (wanted, found) in enumerate(zip(sent[first:], held[first:], strict=False), start=first):
        if wanted != found:
            kept, given = as_kept(wanted, autopilot), as_kept(found, autopilot)
            lines += [f"item {seq}: {line}" for line in _item_differences(kept, given, tolerances)]
    return lines


def _item_differences(sent: MissionItem, held: MissionItem, tolerances: Mapping[str, float]) -> list[str]:
    return [
        f"{name} is {getattr(held, name):.9g}, sent {getattr(sent, name):.9g}"
        for name, tolerance in tolerances.items()
        if not _same(getattr(sent, name), getattr(held, name), tolerance)
    ]


def _same(sent: float, held: float, tolerance: float) -> bool:
    if math.isnan(sent) or math.isnan(held):
        return math.isnan(sent) and math.isnan(held)
    return abs(sent - held) <= tolerance or sent == held
