"""How near two vehicles will come, both taken to fly straight from one predicted place to the next.

In the dialect that plain Python and numba compute bit for bit alike.
"""

import math
from typing import Any

from sitl.avoidance.intent import STEP_S

FAR_M = 1e9
"""Of those who will not come near."""


def least_distance(
    own: Any, own_count: int, other: Any, other_count: int, age_s: float, pace: float, first: int
) -> tuple[float, float]:
    """The least distance of two predictions from the own point `first` on, and in how many seconds.

    Args:
        own, own_count: places and how many there are; points[i] at i STEP_S.
        other, other_count, age_s: of the other, who has told them so long ago.
        pace: that the other goes at since then, in shares of what was told.
    """
    least, at_s = FAR_M * FAR_M, 0.0
    before_x, before_y, before_z = 0.0, 0.0, 0.0
    for i in range(first, own_count):
        place = (i * STEP_S + age_s) * pace / STEP_S
        j = int(place)
        if j + 1 >= other_count:
            break
        share = place - j
        x = own[i][0] - (other[j][0] + share * (other[j + 1][0] - other[j][0]))
        y = own[i][1] - (other[j][1] + share * (other[j + 1][1] - other[j][1]))
        z = own[i][2] - (other[j][2] + share * (other[j + 1][2] - other[j][2]))
        if i > first:
            dx, dy, dz = x - before_x, y - before_y, z - before_z
            moved = dx * dx + dy * dy + dz * dz
            back = 0.0
            if moved > 0.0:
                back = min(max((x * dx + y * dy + z * dz) / moved, 0.0), 1.0)
            near_x, near_y, near_z = x - back * dx, y - back * dy, z - back * dz
            distance = near_x * near_x + near_y * near_y + near_z * near_z
            if distance < least:
                least, at_s = distance, (i - back) * STEP_S
        before_x, before_y, before_z = x, y, z
    return math.sqrt(least), at_s
