"""Which telemetry is due to whom, in simulated time."""

from collections.abc import Callable, Iterable

from sitl.services.peer import Message, Peer
from sitl.services.schedule import TICK_US, Schedule
from sitl.services.stream_messages.streams import STREAMS
from sitl.services.stream_messages.view import View
from sitl.ticks import TICK_S


class Telemetry:
    """The streams of one vehicle. As on ArduPilot, each peer has intervals of its own once it asks for some."""

    def __init__(self) -> None:
        self._default = Schedule()
        self._own: dict[Peer, Schedule] = {}
        self._next_us = 0
        self._now_us = 0

    def is_due(self, time_s: float) -> bool:
        """Whether any stream is due at this simulated time: one comparison, for use at each tick."""
        return _tick_us(time_s) >= self._next_us

    def due(
        self, time_s: float, peers: Iterable[Peer], view: Callable[[], View]
    ) -> list[tuple[list[Peer], list[Message]]]:
        """The messages due at this simulated time, each once however late, and to whom.

        Args:
            time_s: simulated time, a whole number of ticks.
            peers: whoever is there.
            view: called once, and only when something is due to someone.
        """
        self._now_us = now_us = _tick_us(time_s)
        if now_us < self._next_us:
            return []
        wanted = [([peer for peer in peers if peer not in self._own], self._default.take(now_us))]
        wanted += [([peer], schedule.take(now_us)) for peer, schedule in self._own.items()]
        wanted = [(to, due) for to, due in wanted if to and due]
        self._set_next()
        if not wanted:
            return []
        state = view()
        built: dict[int, tuple[Message, ...]] = {}
        for message_id in {message_id for _, due in wanted for message_id in due}:
            stream = STREAMS[message_id]
            built[message_id] = stream.messages(state) if stream.worthwhile(state) else ()
        return [(to, [message for message_id in due for message in built[message_id]]) for to, due in wanted]

    def interval_us(self, peer: Peer, message_id: float) -> int | None:
        """Interval of a stream to a peer, -1 when it is off, None when there is no such stream."""
        return self._own.get(peer, self._default).interval_us(message_id)

    def set_interval_us(self, peer: Peer, message_id: float, interval_us: float) -> bool:
        """Set the interval of a stream to a peer; see `Schedule.set_interval_us`."""
        schedule = self._own.get(peer) or self._default.copy()
        if not schedule.set_interval_us(message_id, interval_us, self._now_us):
            return False
        self._own[peer] = schedule
        self._set_next()
        return True

    def request_group(self, peer: Peer, group: int, rate_hz: int) -> None:
        """Set the intervals of a group of streams to a peer; see `Schedule.request_group`."""
        self._own.setdefault(peer, self._default.copy()).request_group(group, rate_hz, self._now_us)
        self._set_next()

    def forget(self, peer: Peer) -> None:
        """A peer is gone: what it asked for with it."""
        self._own.pop(peer, None)

    def _set_next(self) -> None:
        self._next_us = min(schedule.next_us for schedule in (self._default, *self._own.values()))


def _tick_us(time_s: float) -> int:
    return round(time_s / TICK_S) * TICK_US
