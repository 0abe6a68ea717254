"""Corrections over real Zenoh sessions in real time: nobody waits, arrivals are timed, nonsense stays outside."""

import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack

import pytest
import zenoh

from sitl.formation.correction import Correction, encode
from sitl.formation.live_exchange import FUTURE_TICKS, LiveExchange
from sitl.formation.network import complete
from sitl.ticks import TICK_S
from sitl.zenoh_session import alive_key, correction_key, discard_sockets, local_peers, open_session

SWARM = "test"
DELAY_TICKS = 2


def sample(sysid: int, tick: int) -> Correction:
    return Correction(sysid, tick, tick, True, 0.1 * tick, -0.2)


class Clock:
    """A clock that is set."""

    ticks = 0.0

    def __call__(self) -> float:
        return self.ticks


Pair = tuple[dict[int, zenoh.Session], dict[int, LiveExchange], Clock]


@pytest.fixture
def pair() -> Iterator[Pair]:
    """Vehicles 1 and 2, each other's neighbours."""
    peers, _ = local_peers([1, 2])
    clock = Clock()
    with ExitStack() as stack:
        sessions = {i: stack.enter_context(open_session(peer, real_time=True)) for i, peer in peers.items()}
        network = complete([1, 2], [(1, 2)], DELAY_TICKS)
        exchanges = {i: LiveExchange(sessions[i], SWARM, {i: {3 - i: DELAY_TICKS}}, network, 7, clock) for i in peers}
        tokens = [sessions[i].liveliness().declare_token(alive_key(SWARM, i)) for i in peers]
        assert [exchange.wait_for_neighbours(10) for exchange in exchanges.values()] == [set(), set()]
        yield sessions, exchanges, clock
        del tokens
    for peer in peers.values():
        discard_sockets(peer)


def until(exchange: LiveExchange, condition: Callable[[], bool]) -> None:
    """Let an exchange take in what comes, until something is so."""
    deadline = time.monotonic() + 20
    while not condition():
        assert time.monotonic() < deadline, "it did not come"
        exchange.gather(exchange._tick)
        time.sleep(0.002)


def heard(exchange: LiveExchange) -> int:
    return exchange.reports(1)[0].heard


def test_nobody_waits_and_what_has_come_counts_after_the_delay(pair: Pair) -> None:
    _, exchanges, _ = pair
    exchanges[1].gather(0)
    assert exchanges[1].heard_by(1) == {}
    exchanges[2].publish(sample(2, 0))
    until(exchanges[1], lambda: heard(exchanges[1]) == 1)
    found = []
    for tick in range(DELAY_TICKS + 1):
        exchanges[1].gather(tick)
        found.append(exchanges[1].heard_by(1))
    assert found == [{}, {}, {2: sample(2, 0)}]


def test_real_delay_lateness_and_gaps_are_told_from_stamps_and_sequence_numbers(pair: Pair) -> None:
    _, exchanges, clock = pair
    for count, (tick, at) in enumerate([(0, 0.25), (1, 1.25), (4, 7.0)], start=1):
        clock.ticks = at
        exchanges[2].publish(sample(2, tick))
        until(exchanges[1], lambda count=count: heard(exchanges[1]) == count)  # type: ignore[misc]
    (report,) = exchanges[1].reports(1)
    assert (report.heard, report.late, report.lost, report.refused) == (3, 1, 2, {})
    assert report.delay_max_s == pytest.approx((3 + DELAY_TICKS) * TICK_S)
    assert report.delay_mean_s == pytest.approx((3.5 / 3 + DELAY_TICKS) * TICK_S)


def test_what_is_no_sample_of_the_neighbour_is_counted_by_reason_and_told_once(pair: Pair) -> None:
    sessions, exchanges, clock = pair
    clock.ticks = 50.0
    nonsense = [
        b"nonsense",
        encode(sample(2, 3))[:2] + b"\x07" + encode(sample(2, 3))[3:],
        encode(Correction(2, 3, 3, True, float("nan"), 0.0)),
        encode(sample(9, 3)),
        encode(sample(2, 50 + FUTURE_TICKS + 1)),
    ]
    for payload in [*nonsense, *nonsense]:
        sessions[2].put(correction_key(SWARM, 2), payload, priority=zenoh.Priority.REAL_TIME)
    exchanges[2].publish(sample(2, 50))
    exchanges[2].publish(sample(2, 49))
    until(exchanges[1], lambda: len(exchanges[1].reports(1)[0].refused) == len(nonsense) + 1)
    (report,) = exchanges[1].reports(1)
    assert report.refused == {
        "length no multiple of 72 bytes": 2,
        "not of version 2": 2,
        "not finite": 2,
        "another's system id": 2,
        "far in the future": 2,
        "time goes backwards": 1,
    }
    assert len(exchanges[1].complaints(1)) == 6
    assert exchanges[1].complaints(1) == []
    exchanges[1].gather(50 + DELAY_TICKS)
    assert exchanges[1].heard_by(1) == {2: sample(2, 50)}


def test_vehicles_of_one_process_hear_each_other_through_their_channels() -> None:
    peers, _ = local_peers([1])
    with open_session(peers[1], real_time=True) as session:
        delays = {1: {2: DELAY_TICKS}, 2: {1: DELAY_TICKS}}
        together = LiveExchange(session, SWARM, delays, complete([1, 2], [(1, 2)], DELAY_TICKS), 7, Clock())
        for sysid in (1, 2):
            together.publish(sample(sysid, 0))
        together.gather(DELAY_TICKS)
        assert together.heard_by(1) == {2: sample(2, 0)}
        assert together.heard_by(2) == {1: sample(1, 0)}
    discard_sockets(peers[1])
