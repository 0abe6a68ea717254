"""How long to wait for an answer, from how long answers have taken."""

import math

INITIAL_S = 1.5
"""The MAVLink guide's default time-out, used before anything has been measured."""

SHORTEST_S = 0.25
LONGEST_S = 2.0

GRANULARITY_S = 0.02
"""Least that is allowed for variation, however steady the answers have been."""

TRIES = 5
"""Repeats without progress after which a transfer is given up (the MAVLink guide's)."""


class RoundTrip:
    """Smoothed round-trip time and its variation, as TCP estimates them (RFC 6298).

    Args:
        initial_s: time-out before anything has been measured.
        longest_s: what doubling ends at; a link that is slower still gets what it takes.

    Attributes:
        smoothed_s: the round trip; None before anything has been measured.
        least_s: the shortest that has been measured.
    """

    def __init__(self, initial_s: float = INITIAL_S, longest_s: float = LONGEST_S) -> None:
        self._initial_s = initial_s
        self._longest_s = longest_s
        self.smoothed_s: float | None = None
        self.least_s = math.inf
        self._variation_s = 0.0

    def measure(self, seconds: float) -> None:
        """Take one measured round trip, of a message that was sent once only."""
        self.least_s = min(self.least_s, seconds)
        if self.smoothed_s is None:
            self.smoothed_s, self._variation_s = seconds, seconds / 2
        else:
            self._variation_s += (abs(seconds - self.smoothed_s) - self._variation_s) / 4
            self.smoothed_s += (seconds - self.smoothed_s) / 8

    def timeout_s(self, tries: int, shortest_s: float = SHORTEST_S) -> float:
        """How long to wait for the answer to a message repeated `tries` times: doubled with each."""
        measured_s = None if self.smoothed_s is None else self.smoothed_s + max(GRANULARITY_S, 4 * self._variation_s)
        first_s = self._initial_s if measured_s is None else max(shortest_s, measured_s)
        return max(first_s, min(self._longest_s, first_s * 2.0**tries))
