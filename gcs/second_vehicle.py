"""Telling a second vehicle with the same system id from a second link to the same vehicle."""

import math

from sitl.services.peer import Message

LATENCY_S = 5.0
"""No link is later than this, in wall time."""
SAME_TIME_MS = 200
SAME_PLACE_M = 200.0
"""Within the same 200 ms of its clock a vehicle is at one place."""
WITNESSES = 3
"""So many contradictions in a row are no accident, as a restart of the vehicle between two messages is."""

_METRES_AN_E7 = 6_371_000.0 * math.radians(1e-7)


class SecondVehicle:
    """Compares what comes over a second link with what came over the first. Feed it GLOBAL_POSITION_INT.

    Two vehicles differ in their clocks since boot, or, started together, in their places once they have parted.

    Attributes:
        proven: the two links lead to two vehicles.
    """

    def __init__(self) -> None:
        self._contradictions = 0

    @property
    def proven(self) -> bool:
        """See the class."""
        return self._contradictions >= WITNESSES

    def compare(self, first: Message, second: Message, pace: float) -> None:
        """Take the newest positions heard over the two links.

        Args:
            first, second: GLOBAL_POSITION_INT.
            pace: simulated seconds a second.
        """
        apart_ms = abs(first.time_boot_ms - second.time_boot_ms)
        other_clock = apart_ms > 1000.0 * LATENCY_S * max(1.0, pace)
        other_place = apart_ms <= SAME_TIME_MS and _distance_m(first, second) > SAME_PLACE_M
        if other_clock or other_place:
            self._contradictions += 1
        elif not self.proven:
            self._contradictions = 0


def _distance_m(first: Message, second: Message) -> float:
    north_m = (first.lat - second.lat) * _METRES_AN_E7
    east_m = (first.lon - second.lon) * _METRES_AN_E7 * math.cos(math.radians(first.lat * 1e-7))
    return math.hypot(north_m, east_m)
