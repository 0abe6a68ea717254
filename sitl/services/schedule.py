"""When each stream of one link is due, in simulated time."""

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.stream_messages.streams import OFF_US, STREAMS
from sitl.ticks import TICK_S

TICK_US = round(TICK_S * 1e6)
"""The shortest interval of a stream (25 Hz)."""

_NEVER_US = 2**63
_LONGEST_US = 2**31 - 1
"""What MESSAGE_INTERVAL can say."""


class Schedule:
    """The intervals of the streams, at first their defaults.

    All is counted in whole microseconds, and each stream falls due at multiples of its interval, so that streams of one
    rate leave together.

    Attributes:
        next_us: when the next stream is due.
    """

    def __init__(self) -> None:
        self._intervals_us: dict[float, int] = {
            message_id: stream.interval_us for message_id, stream in STREAMS.items()
        }
        self._due_us = {
            message_id: _NEVER_US if stream.interval_us == OFF_US else 0 for message_id, stream in STREAMS.items()
        }
        self.next_us = 0

    def copy(self) -> "Schedule":
        """One that is like this now, and goes its own way."""
        other = Schedule()
        other._intervals_us, other._due_us = self._intervals_us.copy(), self._due_us.copy()
        other.next_us = self.next_us
        return other

    def take(self, now_us: int) -> list[int]:
        """The streams due at this simulated time, each once however late."""
        if now_us < self.next_us:
            return []
        due = [message_id for message_id, due_us in self._due_us.items() if due_us <= now_us]
        for message_id in due:
            interval_us = self._intervals_us[message_id]
            self._due_us[message_id] = (now_us // interval_us + 1) * interval_us
        self.next_us = min(self._due_us.values())
        return due

    def interval_us(self, message_id: float) -> int | None:
        """Interval of a stream, -1 when it is off, None when there is no such stream."""
        return self._intervals_us.get(message_id)

    def set_interval_us(self, message_id: float, interval_us: float, now_us: int) -> bool:
        """Set a stream's interval as MAV_CMD_SET_MESSAGE_INTERVAL does: 0 the default, -1 off.

        Returns:
            False when there is no such stream or it cannot have that interval.
        """
        if message_id not in self._intervals_us:
            return False
        number = int(message_id)
        if interval_us == 0:
            interval_us = STREAMS[number].interval_us
        if not (interval_us == OFF_US or TICK_US <= interval_us <= _LONGEST_US):
            return False
        interval = int(interval_us)
        self._intervals_us[number] = interval
        self._due_us[number] = _NEVER_US if interval == OFF_US else (now_us // interval + 1) * interval
        self.next_us = min(self._due_us.values())
        return True

    def request_group(self, group: int, rate_hz: int, now_us: int) -> None:
        """Set the intervals of a group of streams as the old REQUEST_DATA_STREAM does.

        Args:
            group: MAV_DATA_STREAM; what is in none is left alone.
            rate_hz: messages a second, at most one a tick; 0 for none.
            now_us: simulated time.
        """
        interval_us = max(TICK_US, round(1e6 / rate_hz)) if rate_hz else OFF_US
        for message_id, stream in STREAMS.items():
            asked = stream.group and group in (stream.group, mavlink.MAV_DATA_STREAM_ALL)
            if asked and self._intervals_us[message_id] != interval_us:
                self.set_interval_us(message_id, interval_us, now_us)
