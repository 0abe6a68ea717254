"""The patterns of formations: where each slot lies, for a spacing between neighbours of 1."""

import math
from typing import Literal, get_args

Pattern = Literal["vee", "line_abreast", "echelon_left", "echelon_right", "column", "diamond", "custom"]
PATTERNS: tuple[str, ...] = get_args(Pattern)

ARM = math.sqrt(0.5)
"""Behind and beside for each slot of an arm swept by 45 degrees."""


def pattern_slots(pattern: Pattern, count: int) -> list[tuple[float, float]]:
    """(behind, left) of `count` slots, the leader's first, neighbours 1 apart.

    Arms fill from the leader outwards, left before right. A diamond is a square standing on its corner, filled row by
    row, each from its middle outwards.
    """
    if pattern == "diamond":
        return _diamond(count)
    slots = []
    for k in range(count):
        wing, side = (k + 1) // 2, 1.0 if k % 2 else -1.0
        if pattern == "vee":
            slots.append((ARM * wing, side * ARM * wing))
        elif pattern == "line_abreast":
            slots.append((0.0, side * wing))
        elif pattern == "column":
            slots.append((float(k), 0.0))
        else:
            slots.append((ARM * k, (ARM if pattern == "echelon_left" else -ARM) * k))
    return slots


def width_of(slots: list[tuple[float, float]]) -> float:
    """From the leftmost to the rightmost slot."""
    return max(left for _, left in slots) - min(left for _, left in slots)


def _diamond(count: int) -> list[tuple[float, float]]:
    side = math.ceil(math.sqrt(count))
    slots = []
    for row in range(2 * side - 1):
        places = min(row + 1, 2 * side - 1 - row)
        across = [2.0 * i - (places - 1) for i in range(places)]
        slots += [(ARM * row, ARM * left) for left in sorted(across, key=lambda left: (abs(left), -left))]
    return slots[:count]
