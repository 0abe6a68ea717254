"""Comparing the mission that was sent with the one that the vehicle holds."""

import math

from missions.mission import Mission, MissionItem

LARGEST_POSITION_DIFFERENCE_E7 = 2
LARGEST_ALTITUDE_DIFFERENCE_M = 0.01
LARGEST_PARAM_DIFFERENCE = 1e-3
"""Autopilots pack what they store: 2 cm, 1 cm (ArduPilot keeps centimetres) and a thousandth are the same."""


def differences(sent: Mission, held: Mission) -> list[str]:
    """What differs, a line each, with item and field; empty when the vehicle holds what was sent.

    Item 0 is the vehicle's own home, which replaces the one sent, and is not compared.
    """
    lines = []
    if len(sent) != len(held):
        lines.append(f"{len(held)} items held, {len(sent)} sent")
    for seq, (wanted, found) in enumerate(zip(sent, held, strict=False)):
        if seq > 0:
            lines += [f"item {seq}: {line}" for line in _item_differences(wanted, found)]
    return lines


def _item_differences(sent: MissionItem, held: MissionItem) -> list[str]:
    allowed = {
        "command": 0.0,
        "frame": 0.0,
        "param1": LARGEST_PARAM_DIFFERENCE,
        "param2": LARGEST_PARAM_DIFFERENCE,
        "param3": LARGEST_PARAM_DIFFERENCE,
        "param4": LARGEST_PARAM_DIFFERENCE,
        "lat_e7": LARGEST_POSITION_DIFFERENCE_E7,
        "lon_e7": LARGEST_POSITION_DIFFERENCE_E7,
        "alt_m": LARGEST_ALTITUDE_DIFFERENCE_M,
        "autocontinue": 0.0,
    }
    return [
        f"{name} is {getattr(held, name):.9g}, sent {getattr(sent, name):.9g}"
        for name, tolerance in allowed.items()
        if not _same(getattr(sent, name), getattr(held, name), tolerance)
    ]


def _same(sent: float, held: float, tolerance: float) -> bool:
    if math.isnan(sent) or math.isnan(held):
        return math.isnan(sent) and math.isnan(held)
    return abs(sent - held) <= tolerance or sent == held
