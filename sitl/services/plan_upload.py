"""One upload that is running: the items so far, and the messages that ask for the rest."""

from collections.abc import Callable, Iterable, Set

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from missions.mission import MissionItem
from missions.plan_type import PlanType
from sitl.services.peer import Message, Station
from sitl.services.request_window import Order, RequestWindow

GIVE_UP_S = 8.0
"""ArduPlane's: an upload without progress ends after so long."""

_OTHER_KIND_S = 2.0
"""Without progress for so long, the other kind of request is tried again."""


class PlanUpload:
    """Items `first` to `last` of a plan, staged; the plan held is not touched.

    They are asked for with MISSION_REQUEST_INT. While nothing comes, MISSION_REQUEST takes turns with it, for the
    stations that know only that one (dronekit, MAVProxy).

    Args:
        plan: the type of the plan.
        station: who uploads.
        base: the plan that the items replace a stretch of; as long as the new one.
        first, last: the stretch, both included.
        now: wall time in seconds; only differences matter.
        strict: whether the station is known to answer in strict order only.
        old_requests: whether to begin with MISSION_REQUEST.
        asked_before: items that it has been asked for in an upload that it has begun anew.
    """

    def __init__(
        self,
        plan: PlanType,
        station: Station,
        base: Iterable[MissionItem | None],
        first: int,
        last: int,
        now: Callable[[], float],
        *,
        strict: bool,
        old_requests: bool = False,
        asked_before: Set[int] = frozenset(),
    ) -> None:
        self.plan = plan
        self.station = station
        self.last = last
        self.window = RequestWindow(first, last, now, strict=strict, asked_before=asked_before)
        self._now = now
        self._items = list(base)
        self._old_requests = old_requests
        self._heard = False

    @property
    def count(self) -> int:
        """Items of the whole plan."""
        return len(self._items)

    @property
    def gives_up_at_s(self) -> float:
        """When it has waited long enough for an item."""
        return self.window.progress_at_s + GIVE_UP_S

    @property
    def deadline_s(self) -> float:
        """When there is something to ask for again, or to give up."""
        return min(self.gives_up_at_s, self.window.deadline_s)

    @property
    def strict(self) -> bool:
        """Whether the station has been found to be strict."""
        return self.window.order is Order.STRICT

    @property
    def unheard_requests(self) -> bool | None:
        """The kind of requests that nothing has come of yet: whether MISSION_REQUEST; None when something has."""
        return None if self._heard else self._old_requests

    def take(self, seq: int, item: MissionItem) -> None:
        """Stage an item that the window wants."""
        self._items[seq] = item
        self._heard = True
        self.window.receive(seq)

    def whole(self) -> tuple[MissionItem, ...]:
        """The new plan; the window must be complete."""
        return tuple(item for item in self._items if item is not None)

    def requests(self) -> list[Message]:
        """Ask for what an item that has come makes room for."""
        return [self.request(seq) for seq in self.window.requests()]

    def overdue(self) -> list[Message]:
        """Ask again for what is overdue."""
        seqs = self.window.requests()
        if seqs and (not self._heard or self._now() - self.window.progress_at_s >= _OTHER_KIND_S):
            self._old_requests = not self._old_requests
        return [self.request(seq) for seq in seqs]

    def ask_again(self) -> list[Message]:
        """Tell the station once more what is expected of it."""
        return [self.request(seq) for seq in self.window.ask_again()]

    def refuse_old_requests(self) -> list[Message]:
        """The station knows no MISSION_REQUEST (MAVSDK answers it UNSUPPORTED): use the other kind."""
        if not self._old_requests:
            return []
        self._old_requests = False
        return self.ask_again()

    def request(self, seq: int) -> Message:
        """What asks for one item."""
        kind = (
            mavlink.MAVLink_mission_request_message
            if self._old_requests
            else mavlink.MAVLink_mission_request_int_message
        )
        return kind(self.station.sysid, self.station.compid, seq, int(self.plan))
