"""What the stations are to know at once when it changes, rather than when its stream is due."""

from collections.abc import Callable

from sitl.services.heartbeat import heartbeat
from sitl.services.peer import Message
from sitl.services.stream_messages.health import extended_sys_state, fence_status
from sitl.services.stream_messages.home import home_position
from sitl.services.stream_messages.mission import mission_current
from sitl.services.stream_messages.modes import current_mode
from sitl.services.stream_messages.view import View

_WATCHED: tuple[tuple[Callable[[View], object], Callable[[View], Message]], ...] = (
    (lambda view: (view.snapshot.mode, view.snapshot.armed, view.snapshot.failsafe), lambda v: heartbeat(v.snapshot)),
    (lambda view: view.snapshot.mode, current_mode),
    (lambda view: view.snapshot.landed, extended_sys_state),
    (lambda view: (view.snapshot.breach_status, view.snapshot.breach_count), fence_status),
    (lambda view: (view.snapshot.current_seq, view.plan_ids), mission_current),
    (lambda view: view.home, home_position),
)
"""What is watched, and the message that tells it."""


class News:
    """Notices changes from one view to the next; what there is at first is no news."""

    def __init__(self) -> None:
        self._known: list[object] = []

    def of(self, view: View) -> list[Message]:
        """The messages for what has changed since the last view."""
        known, self._known = self._known, [key(view) for key, _ in _WATCHED]
        if not known:
            return []
        return [build(view) for (_, build), old, new in zip(_WATCHED, known, self._known, strict=True) if old != new]
