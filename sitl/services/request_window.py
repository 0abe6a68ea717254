"""Which items of an upload to ask for, and when: a window of requests that opens to stations able to fill it."""

from collections.abc import Callable, Set
from dataclasses import dataclass, replace
from enum import Enum

from sitl.services.loss import Loss, learn
from sitl.services.round_trip import RoundTrip

MAX_OUTSTANDING = 32
"""Requests on their way, copies included; the items that answer them are 1.6 kB, 0.3 s of a radio of 57600 baud."""

UNMEASURED = 8
"""The same before a round trip has been measured: on a slow link all of them will have been repeated."""

_LATER_ANSWERS = 3
"""A request is lost once one that was made so many later has been answered."""
_PROBE_LENGTH = 3
_PROBES = 3
"""Probes that a station may leave unanswered before it counts as strict: a loss of 25 % each way alone does that to one
upload in 1500."""

_INITIAL_S = 0.3
_LONGEST_S = 1.2
"""QGroundControl gives up after 1.5 s without a request."""

_SHORTEST_S = 0.1

_TRIES_AT_ONE_PACE = 2
_DOUBLINGS = 1
"""What is lost on a radio is no sign of a queue: repeats slow down late, and once the round trip is known, little."""


class Order(Enum):
    """What a station has shown of itself."""

    UNKNOWN = "unknown"
    """Asked for one item, and for a few ahead of it; which of them it answers will tell."""

    ANY = "any"
    """It answers any request: the window is open."""

    STRICT = "strict"
    """It answers one item after the other only."""


@dataclass(frozen=True)
class _Request:
    """The newest request for one item.

    Attributes:
        at_s: when it was made.
        first_at_s: when the first for this item was.
        repeated: whether there had been one.
        serial: as the how manyth of all it was made.
        copies: how often it was sent.
    """

    at_s: float
    first_at_s: float
    repeated: bool
    serial: int
    copies: int = 1


class RequestWindow:
    """Decides what to ask for. Tell it what has come with `receive`, ask it for `requests` after that and with time.

    The next item is asked for and, before it, a few beyond the one after that: a strict station (MAVSDK's client)
    ignores what is ahead of the item it expects and is none the worse, whatever order they come in; any other answers
    and is asked for a window of items at a time. The last item is asked for when all others are in, since MAVProxy ends
    its upload with it and MAVSDK succeeds only when it was the last it sent. An item is asked for again when later
    requests have been answered, or when it is overdue by the measured round trip. On a link that is seen to lose, a
    request is sent in copies, as far as the window has room for them: nothing is ever added to a full one.

    A station that begins anew is asked for the first item alone: until it has answered that, it may be answering
    requests of the upload before.

    A strict station is walked through the items one by one. It may have gone back (MAVSDK's client does, to the item
    asked for last) and be waiting for a request that is behind: when repeats are of no use, the walk goes back too,
    a little further each time, and passes items again that are in already.

    Args:
        first, last: the items wanted, both included.
        now: current time in seconds; only differences matter.
        strict: whether the station is known to be strict.
        asked_before: items that it has been asked for in an upload that it has begun anew.

    Attributes:
        order: what the station has shown of itself.
        progress_at_s: when an item last came.
    """

    def __init__(
        self,
        first: int,
        last: int,
        now: Callable[[], float],
        *,
        strict: bool = False,
        asked_before: Set[int] = frozenset(),
    ) -> None:
        self.order = Order.STRICT if strict else Order.UNKNOWN
        self.progress_at_s = now()
        self._loss = Loss()
        self._now = now
        self._first = first
        self._last = last
        self._lowest = first
        self._ahead: set[int] = set()
        self._asked_before = asked_before
        self._asked: set[int] = set()
        self._outstanding: dict[int, _Request] = {}
        self._serial = 0
        self._answered_serial = 0
        self._next = first
        self._probes = 0
        self._complained = False
        self._cursor = first
        self._depth = 0
        self._answered_to = first
        self._round_trip = RoundTrip(_INITIAL_S, _LONGEST_S)
        self._stalls = 0
        self._stalled_at_s = now()

    @property
    def lowest(self) -> int:
        """The first item that is not in yet."""
        return self._lowest

    @property
    def complete(self) -> bool:
        """Whether all items are in."""
        return self._lowest > self._last

    @property
    def asked(self) -> Set[int]:
        """Items that the station may be answering."""
        return self._asked | self._asked_before

    @property
    def outstanding(self) -> frozenset[int]:
        """Items asked for that have not come."""
        return frozenset(self._outstanding)

    @property
    def copies(self) -> int:
        """How often to say what another round trip would be waited for; once to a station that may be strict."""
        return self._loss.copies if self.order is Order.ANY else 1

    @property
    def deadline_s(self) -> float:
        """When `requests` has something to ask for again."""
        for request in self._outstanding.values():
            return request.at_s + self._wait_s()
        return self._now()

    def wants(self, seq: int) -> bool:
        """Whether an item has been asked for and is not in yet."""
        return seq in self._asked and not self.has(seq)

    def has(self, seq: int) -> bool:
        """Whether an item is in."""
        return seq < self._lowest or seq in self._ahead

    def receive(self, seq: int) -> None:
        """An item has come, one that is wanted or a repeat."""
        request = self._outstanding.pop(seq, None)
        self._answered_to = seq + 1
        wanted = self.wants(seq)
        if wanted:
            self._hold(seq, request)
        if self.order is Order.STRICT and (seq == self._cursor or (wanted and seq < self._lowest)):
            self._outstanding.clear()
            self._cursor = min(seq + 1, self._lowest)
            self._stalls = 0

    def fall_back(self) -> None:
        """The station has complained: one item at a time from now on."""
        self.order = Order.STRICT
        self._complained = True
        self._outstanding.clear()
        self._cursor = min(self._lowest, self._answered_to)

    def ask_again(self) -> list[int]:
        """The station does not know what is wanted: the first item that is, unless it has just been asked for."""
        seq = self._cursor if self.order is Order.STRICT else self._lowest
        request = self._outstanding.get(seq)
        if self.complete or (request is not None and self._now() < request.at_s + _SHORTEST_S):
            return []
        self._ask(seq)
        return [seq]

    def requests(self) -> list[int]:
        """The items to ask for now, in the order to ask; copies follow."""
        if self.complete:
            return []
        if self.order is Order.ANY:
            asked = self._overtaken() + self._overdue()
            asked += self._fill()
        elif self.order is Order.UNKNOWN:
            asked = self._overdue()
            asked += self._probe()
        else:
            asked = self._walk(self._overdue())
        for seq in asked:
            self._ask(seq)
        return asked + self._copies(asked)

    def _hold(self, seq: int, request: _Request | None) -> None:
        """Note an item that was wanted, the progress that it is, and what it tells of the station."""
        if request is not None and seq not in self._asked_before and self._learn(request):
            self._answered_serial = max(self._answered_serial, request.serial)
        if self._round_trip.smoothed_s is not None:
            self._stalls = 0
        self.progress_at_s = self._now()
        self._depth = 0
        in_order = seq == self._lowest
        self._ahead.add(seq)
        while self._lowest in self._ahead:
            self._ahead.remove(self._lowest)
            self._lowest += 1
        if self.order is Order.ANY:
            return
        if not in_order and not self._complained:
            self._open()
        elif self.order is Order.UNKNOWN and self._outstanding:
            self._count_probe()

    def _learn(self, request: _Request) -> bool:
        """Learn what an answer tells; whether it is one to the newest request for its item."""
        took_s, since_first_s = self._now() - request.at_s, self._now() - request.first_at_s
        if self.order is Order.ANY:
            return learn(self._round_trip, self._loss, took_s, since_first_s if request.repeated else None)
        # A strict station repeats items unasked, and gives up when it is asked too often: patience errs on its side.
        known_s = self._round_trip.smoothed_s
        if not request.repeated:
            self._round_trip.measure(took_s)
        elif known_s is not None and took_s < known_s / 2:
            self._round_trip.measure(since_first_s)
        return False

    def _open(self) -> None:
        """The station has answered out of order."""
        self.order = Order.ANY
        self._next = self._lowest
        for seq in [seq for seq in self._outstanding if self.has(seq)]:
            del self._outstanding[seq]

    def _walk(self, overdue: list[int]) -> list[int]:
        """The item where the walk is, when it is time to ask for it."""
        if overdue and self._stalls % _TRIES_AT_ONE_PACE == 0 and self._cursor > self._first:
            self._outstanding.clear()
            if self._cursor == self._lowest:
                self._depth += 1
                self._cursor = max(self._first, self._lowest - self._depth)
            else:
                self._cursor = self._lowest
        elif self._outstanding and not overdue:
            return []
        return [self._cursor]

    def _wait_s(self) -> float:
        tries = self._stalls // _TRIES_AT_ONE_PACE
        if self._round_trip.smoothed_s is not None:
            tries = min(tries, _DOUBLINGS)
        return self._round_trip.timeout_s(tries, _SHORTEST_S)

    def _overtaken(self) -> list[int]:
        """What was asked for long enough before a request that has been answered."""
        lost = []
        for seq, request in self._outstanding.items():
            if request.serial > self._answered_serial - _LATER_ANSWERS:
                break
            lost.append(seq)
        for seq in lost:  # not overdue any more
            self._ask(seq)
        return lost

    def _overdue(self) -> list[int]:
        now_s, wait_s = self._now(), self._wait_s()
        overdue = []
        for seq, request in self._outstanding.items():
            if now_s < request.at_s + wait_s:
                break
            overdue.append(seq)
        if overdue and now_s >= self._stalled_at_s + wait_s:
            self._stalls += 1
            self._stalled_at_s = now_s
        return overdue

    def _count_probe(self) -> None:
        """The next item has come, and none of those ahead: they or their requests are lost, or it is strict."""
        self._probes += 1
        self._outstanding.clear()
        if self._probes == _PROBES:
            self.order = Order.STRICT
            self._cursor = self._lowest

    def _probe(self) -> list[int]:
        """The next item, and before it some ahead that a strict station cannot come to."""
        if self._outstanding:
            return []
        if self._asked_before and self._lowest == self._first:
            return [self._first]
        ahead = range(self._lowest + 2, min(self._lowest + 2 + _PROBE_LENGTH, self._last))
        return [*reversed(ahead), self._lowest]

    def _fill(self) -> list[int]:
        """New items, as far as the window is open; the last one at the end."""
        new: list[int] = []
        room = self._room()
        while len(new) < room and self._next < self._last:
            if not self.has(self._next) and self._next not in self._outstanding:
                new.append(self._next)
            self._next += 1
        if self._lowest == self._last and self._last not in self._outstanding:
            new.append(self._last)
        return new

    def _room(self) -> int:
        """How many more requests may be on their way."""
        window = UNMEASURED if self._round_trip.smoothed_s is None else MAX_OUTSTANDING
        return window - sum(request.copies for request in self._outstanding.values())

    def _copies(self, asked: list[int]) -> list[int]:
        """What to ask once more, and again, at once."""
        if not asked:
            return []
        more = min(self.copies - 1, self._room() // len(asked))
        for seq in asked if more > 0 else ():
            self._outstanding[seq] = replace(self._outstanding[seq], copies=1 + more)
        return asked * more

    def _ask(self, seq: int) -> None:
        """Note a request; the outstanding ones stay in the order in which they were made."""
        now_s = self._now()
        earlier = self._outstanding.pop(seq, None)
        first_at_s = now_s if earlier is None else earlier.first_at_s
        self._serial += 1
        self._outstanding[seq] = _Request(now_s, first_at_s, repeated=seq in self._asked, serial=self._serial)
        self._asked.add(seq)
