"""Which telemetry message is due when, in simulated time."""

from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from sitl.services.peer import Message
from sitl.services.stream_messages.streams import OFF_US, STREAMS
from sitl.services.stream_messages.view import View
from sitl.ticks import TICK_S

TICK_US = round(TICK_S * 1e6)
"""The shortest interval of a stream (25 Hz)."""

_NEVER_US = 2**63
_LONGEST_US = 2**31 - 1
"""What MESSAGE_INTERVAL can say."""


class Telemetry:
    """The streams of one vehicle, the same for all its stations.

    All is counted in whole microseconds, and each stream falls due at multiples of its interval, so that streams of one
    rate leave together.
    """

    def __init__(self) -> None:
        self._intervals_us = {message_id: stream.interval_us for message_id, stream in STREAMS.items()}
        self._due_us = {
            message_id: _NEVER_US if interval == OFF_US else 0 for message_id, interval in self._intervals_us.items()
        }
        self._next_us = 0
        self._last_us = 0

    def is_due(self, time_s: float) -> bool:
        """Whether any stream is due at this simulated time: one comparison, for use at each tick."""
        return _tick_us(time_s) >= self._next_us

    def due(self, time_s: float, view: Callable[[], View]) -> list[Message]:
        """The messages due at this simulated time, each once however late.

        Args:
            time_s: simulated time, a whole number of ticks.
            view: called once, and only when something is due.
        """
        now_us = _tick_us(time_s)
        self._last_us = now_us
        if now_us < self._next_us:
            return []
        due = [message_id for message_id, due_us in self._due_us.items() if due_us <= now_us]
        for message_id in due:
            interval_us = self._intervals_us[message_id]
            self._due_us[message_id] = (now_us // interval_us + 1) * interval_us
        self._next_us = min(self._due_us.values())
        state = view()
        messages: list[Message] = []
        for message_id in due:
            stream = STREAMS[message_id]
            if stream.when is None or stream.when(state):
                messages += stream.messages(state)
        return messages

    def interval_us(self, message_id: float) -> int | None:
        """Interval of a stream, -1 when it is off, None when there is no such stream."""
        return self._intervals_us.get(message_id)  # type: ignore[call-overload, no-any-return]

    def set_interval_us(self, message_id: float, interval_us: float) -> bool:
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
        self._due_us[number] = _NEVER_US if interval == OFF_US else (self._last_us // interval + 1) * interval
        self._next_us = min(self._due_us.values())
        return True

    def request_group(self, group: int, rate_hz: int, *, start: bool) -> None:
        """Set the intervals of a group of streams as the old REQUEST_DATA_STREAM does.

        Args:
            group: MAV_DATA_STREAM; what is in none is left alone.
            rate_hz: messages a second, at most one a tick; 0 for none.
            start: whether there shall be any.
        """
        interval_us = max(TICK_US, round(1e6 / rate_hz)) if start and rate_hz else OFF_US
        for message_id, stream in STREAMS.items():
            asked = stream.group and group in (stream.group, mavlink.MAV_DATA_STREAM_ALL)
            if asked and self._intervals_us[message_id] != interval_us:
                self.set_interval_us(message_id, interval_us)


def _tick_us(time_s: float) -> int:
    return round(time_s / TICK_S) * TICK_US
