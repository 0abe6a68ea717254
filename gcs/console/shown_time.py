"""The time that is shown of a live flight: it goes evenly, a little behind what has been heard."""

from collections import deque

WINDOW_S = 2.5
"""Wall time over which it is measured how fast simulated time goes."""
PULL_PER_S = 1.5
"""How fast what is shown comes to where it should be."""
STEPS = 1.15
"""So many of them what is shown is behind: a sample may come a little late."""
LEAP_S = 1.0
"""Wall time; what is further off than this, and some steps, is gone to at once."""


class ShownTime:
    """Telemetry comes in steps; what is shown must not.

    What has been heard lies on steps below a line: the time that it is there, as far as anybody here can know. What is
    shown follows that line, a step behind it.

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
        self._hear(newest_s)
        there_s = self._time_there_s()
        wanted_s = min(newest_s, there_s - STEPS * step_s) if self.rate > 0.0 else newest_s
        behind_s = wanted_s - self.t_s
        if abs(behind_s) > 4.0 * step_s + self.rate * LEAP_S:
            self.t_s = wanted_s  # just found, begun anew, or the browser's machine slept
        else:
            self.t_s += max(0.0, passed_s * self.rate + min(1.0, passed_s * PULL_PER_S) * behind_s)
        self.t_s = min(self.t_s, newest_s)
        return self.t_s

    def _hear(self, newest_s: float) -> None:
        """Note each step when it comes, and how fast they come."""
        if self._heard and newest_s < self._heard[-1][1]:
            self._heard.clear()
        if not self._heard or newest_s > self._heard[-1][1]:
            self._heard.append((self._wall_s, newest_s))
        while len(self._heard) > 1 and self._wall_s - self._heard[0][0] > WINDOW_S:
            self._heard.popleft()
        (first_wall_s, first_s), (last_wall_s, last_s) = self._heard[0], self._heard[-1]
        if self._wall_s - last_wall_s > WINDOW_S:
            self.rate = 0.0
        elif last_wall_s > first_wall_s:
            self.rate = (last_s - first_s) / (last_wall_s - first_wall_s)

    def _time_there_s(self) -> float:
        """The line through the foremost of the steps."""
        return max(heard_s + self.rate * (self._wall_s - wall_s) for wall_s, heard_s in self._heard)
