"""Noticing that the station has fallen silent, in wall time, and that it is back; what that leads to (FS_LONG_ACTN)."""

from enum import IntEnum


class StationAction(IntEnum):
    """Values of FS_LONG_ACTN."""

    CONTINUE = 0
    RTL = 1
    AUTO = 4

    @property
    def words(self) -> str:
        """For the pilot."""
        return "flying on" if self == StationAction.CONTINUE else self.name


class StationWatch:
    """Feed it what is heard and the time."""

    def __init__(self) -> None:
        self.lost = False
        self._heard_s: float | None = None

    def hear(self, now_s: float) -> bool:
        """The station has been heard. Returns whether it had been lost."""
        self._heard_s = now_s
        was_lost, self.lost = self.lost, False
        return was_lost

    def falls_silent(self, now_s: float, timeout_s: float) -> bool:
        """Whether the station is lost from now on: it was heard once, and not for this long."""
        if self.lost or self._heard_s is None or now_s - self._heard_s <= timeout_s:
            return False
        self.lost = True
        return True
