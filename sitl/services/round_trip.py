"""How long to wait for an answer, from how long answers have taken."""

INITIAL_S = 1.5
"""The MAVLink guide's default time-out, used before anything has been measured."""

SHORTEST_S = 0.25
LONGEST_S = 2.0

TRIES = 5
"""Repeats without progress after which a transfer is given up (the MAVLink guide's)."""


class RoundTrip:
    """Smoothed round-trip time and its variation, as TCP estimates them (RFC 6298)."""

    def __init__(self) -> None:
        self._smoothed_s: float | None = None
        self._variation_s = 0.0

    def measure(self, seconds: float) -> None:
        """Take one measured round trip, of a message that was sent once only."""
        if self._smoothed_s is None:
            self._smoothed_s, self._variation_s = seconds, seconds / 2
        else:
            self._variation_s += (abs(seconds - self._smoothed_s) - self._variation_s) / 4
            self._smoothed_s += (seconds - self._smoothed_s) / 8

    def timeout_s(self, tries: int) -> float:
        """How long to wait for the answer to a message repeated `tries` times: doubled with each."""
        measured_s = None if self._smoothed_s is None else self._smoothed_s + 4 * self._variation_s
        first_s = INITIAL_S if measured_s is None else max(SHORTEST_S, measured_s)
        return min(LONGEST_S, first_s * 2.0**tries)
