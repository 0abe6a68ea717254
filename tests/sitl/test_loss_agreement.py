"""All who are left count a loss from one tick, in whatever order they learn of it; who may be cut off counts none."""

import queue
import threading
from collections.abc import Callable
from contextlib import ExitStack

import pytest
from hypothesis import given
from hypothesis import strategies as st

from missions.reassignment import Loss
from sitl.loss_agreement import LossAgreement
from sitl.loss_exchange import agree_over_zenoh
from sitl.ticks import TICK_S
from sitl.zenoh_session import discard_sockets, local_peers, losses_key, open_session

EVERYONE = (1, 2, 3, 4, 5)
Told = tuple[int, frozenset[int], int]


class Swarm:
    """Agreements of vehicles on their own; what they tell is on its way until it is delivered, in order of each."""

    def __init__(self, patience_ticks: int = 0) -> None:
        self.under_way: list[tuple[int, Told]] = []
        self.of = {
            sysid: LossAgreement((sysid,), EVERYONE, lambda *told: self._send(told), patience_ticks)
            for sysid in EVERYONE
        }

    def _send(self, told: Told) -> None:
        self.under_way += [(to, told) for to in EVERYONE if to != told[0]]

    def deliver(self, to: int, sender: int) -> None:
        """The oldest of one link."""
        for i, (receiver, told) in enumerate(self.under_way):
            if (receiver, told[0]) == (to, sender):
                self.of[to].hear(*self.under_way.pop(i)[1])
                return


@given(
    ticks=st.lists(st.integers(0, 40), min_size=5, max_size=5),
    lost=st.sampled_from(EVERYONE),
    order=st.randoms(use_true_random=False),
)
def test_all_count_a_loss_from_the_tick_at_which_the_last_has_noticed(
    ticks: list[int], lost: int, order: object
) -> None:
    swarm, left = Swarm(), [sysid for sysid in EVERYONE if sysid != lost]
    steps: list[Callable[[], None]] = [
        lambda sysid=sysid: swarm.of[sysid].miss({lost}, ticks[sysid - 1])  # type: ignore[misc]
        for sysid in left
    ]
    order.shuffle(steps)  # type: ignore[attr-defined]
    for step in steps:
        step()
        if swarm.under_way and order.random() < 0.5:  # type: ignore[attr-defined]
            to, told = order.choice(swarm.under_way)  # type: ignore[attr-defined]
            swarm.deliver(to, told[0])
    while swarm.under_way:
        waiting = [sysid for sysid in left if not swarm.of[sysid].is_settled()]
        assert all(swarm.of[sysid].agreed() is None for sysid in waiting)
        to, told = order.choice(swarm.under_way)  # type: ignore[attr-defined]
        swarm.deliver(to, told[0])
    expected = Loss(max(ticks[sysid - 1] for sysid in left) * TICK_S, frozenset({lost}))
    for sysid in left:
        assert swarm.of[sysid].is_settled()
    assert [swarm.of[sysid].agreed() for sysid in left] == [expected] * len(left)


def test_a_loss_is_counted_once_and_a_second_one_by_itself() -> None:
    one = LossAgreement((1,), (1, 2, 3, 4, 5, 6), lambda *told: None)
    one.miss({4}, 10)
    assert one.agreed() is None
    for other in (2, 3, 5, 6):
        one.hear(other, frozenset({4}), 12 + other)
    assert one.agreed() == Loss(18 * TICK_S, frozenset({4}))
    assert one.agreed() is None
    one.miss({4, 5}, 30)
    assert not one.is_settled()
    for other in (2, 3, 6):
        one.hear(other, frozenset({4, 5}), 29)
    assert one.agreed() == Loss(30 * TICK_S, frozenset({5}))


def test_half_a_swarm_or_less_agrees_on_nothing_and_waits_for_nobody() -> None:
    told: list[Told] = []
    one = LossAgreement((1,), (1, 2, 3, 4), lambda *some: told.append(some))
    one.miss({3, 4}, 10)
    assert one.is_settled()
    one.hear(2, frozenset({3, 4}), 10)
    assert one.agreed() is None


def test_who_is_back_within_the_patience_was_never_missed() -> None:
    told: list[Told] = []
    one = LossAgreement((1,), EVERYONE, lambda *some: told.append(some), patience_ticks=250)
    for tick in range(200):
        one.miss({3}, tick)
    one.miss(set(), 200)
    assert told == []
    for tick in range(201, 452):
        one.miss({3}, tick)
    assert told == [(1, frozenset({3}), 451)]


def test_processes_agree_over_zenoh_and_nonsense_is_not_heard() -> None:
    peers, _ = local_peers([1, 2])
    here = {1: (1, 2), 2: (3, 4)}
    everyone = (1, 2, 3, 4, 5)
    with ExitStack() as stack:
        sessions = {number: stack.enter_context(open_session(peer)) for number, peer in peers.items()}
        inboxes: dict[int, queue.SimpleQueue[Callable[[], None]]] = {number: queue.SimpleQueue() for number in peers}
        of = {n: agree_over_zenoh(sessions[n], "test", here[n], everyone, inboxes[n], 0) for n in peers}
        listening = threading.Event()
        querier = sessions[2].declare_publisher(losses_key("test", 4))
        while not querier.matching_status.matching:
            listening.wait(0.01)
        for payload in (b"nonsense", b'{"missed": [5], "tick": -1}', b'{"missed": [4], "tick": 7}', b'{"missed": 5}'):
            querier.put(payload)
        of[1].miss({5}, 7)
        of[2].miss({5}, 11)
        for number, agreement in of.items():
            while not agreement.is_settled():
                inboxes[number].get(timeout=10)()
            assert agreement.agreed() == Loss(11 * TICK_S, frozenset({5}))
    for peer in peers.values():
        discard_sockets(peer)


@pytest.mark.parametrize("count", [3, 4])
def test_one_process_with_all_who_are_left_has_agreed_at_once(count: int) -> None:
    everyone = tuple(range(1, count + 1))
    one = LossAgreement(everyone, everyone, lambda *told: None)
    one.miss({count}, 5)
    assert one.agreed() == Loss(5 * TICK_S, frozenset({count}))
