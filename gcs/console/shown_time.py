"""The time that is shown of a live flight: it goes evenly, a little behind what has been heard."""

from collections import deque

RATE_WINDOW_S = 2.0
"""Wall time over which it is measured how fast simulated time goes."""
PULL_PER_S = 1.5
"""How fast what is shown comes to where it should be."""


class ShownTime:
    """Telemetry comes in steps; what is shown must not.

    Attributes:
        t_s: what is shown.
        rate: simulated seconds a second.
    """

    def __init__(self) -> None:
        self.t_s = 0.0
        self.rate = 0.0
        self._heard: deque[tuple[float, float]] = deque()
        self._wall_s = 0.0

    def advance(self, passed_s: float, newest_s: float, step_s: float) -> float:
        """Go on.

        Args:
            passed_s: wall time since the last call.
            newest_s: up to when all vehicles have been heard.
            step_s: between two samples of a vehicle, simulated time.

        Returns:
            The time to show.
        """
        self._wall_s += passed_s
        self._heard.append((self._wall_s, newest_s))
        while self._wall_s - self._heard[0][0] > RATE_WINDOW_S:
            self._heard.popleft()
        first_wall_s, first_s = self._heard[0]
        if (window_s := self._wall_s - first_wall_s) > 0.0:
            self.rate = max(0.0, newest_s - first_s) / window_s
        wanted_s = newest_s - step_s if self.rate > 0.0 else newest_s
        behind_s = wanted_s - self.t_s
        if abs(behind_s) > 4.0 * step_s + self.rate * 1.0:
            self.t_s = wanted_s  # just found, begun anew, or the browser's machine slept
        else:
            self.t_s += max(0.0, passed_s * self.rate + min(1.0, passed_s * PULL_PER_S) * behind_s)
        self.t_s = min(self.t_s, newest_s)
        return self.t_s
