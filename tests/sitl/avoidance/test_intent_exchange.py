"""Intents over real Zenoh sessions: waited for when they count, not before, and not of those who have gone."""

import threading
from collections.abc import Iterator
from contextlib import ExitStack

import pytest
import zenoh

from sitl.avoidance.intent import PERIOD_TICKS, YIELDS, Intent, encode, intent_at
from sitl.avoidance.intent_exchange import IntentExchange
from sitl.formation.channel import Channel
from sitl.formation.failures import FOR_EVER, Failure
from sitl.formation.network import Network
from sitl.zenoh_session import alive_key, discard_sockets, intent_key, local_peers, open_session

SWARM = "test"
DELAY_TICKS = 5
KILLED_AT = 110
NETWORK = Network(
    (1, 2, 3), (), Channel(DELAY_TICKS), failures=(Failure("kill", frozenset({3}), (), (KILLED_AT, FOR_EVER)),)
)
Pair = tuple[dict[int, zenoh.Session], dict[int, IntentExchange]]


def told(sysid: int, k: int) -> Intent:
    return intent_at(sysid, k * PERIOD_TICKS, YIELDS, ((1.0, 2.0, 3.0),))


@pytest.fixture
def pair() -> Iterator[Pair]:
    """Vehicle 1 in a process, and 2 and 3 in another."""
    peers, _ = local_peers([1, 2])
    with ExitStack() as stack:
        sessions = {number: stack.enter_context(open_session(peer)) for number, peer in peers.items()}
        here = {1: [1], 2: [2, 3]}
        exchanges = {number: IntentExchange(sessions[number], SWARM, here[number], NETWORK) for number in peers}
        tokens = [
            sessions[number].liveliness().declare_token(alive_key(SWARM, sysid))
            for number, sysids in here.items()
            for sysid in sysids
        ]
        for exchange in exchanges.values():
            assert exchange.wait_for_others(10) == set()
        yield sessions, exchanges
        del tokens
    for peer in peers.values():
        discard_sockets(peer)


def test_all_hear_all_others_once(pair: Pair) -> None:
    _, exchanges = pair
    for number, sysid in ((1, 1), (2, 2), (2, 3)):
        exchanges[number].publish(told(sysid, 0))
    for number, sysid in ((1, 1), (2, 2), (2, 3)):
        exchanges[number].gather(PERIOD_TICKS)
        others = {1, 2, 3} - {sysid}
        assert exchanges[number].take(sysid) == {other: [(told(other, 0), 0)] for other in others}
        assert exchanges[number].take(sysid) == {}


def test_only_what_has_had_its_delay_is_waited_for(pair: Pair) -> None:
    _, exchanges = pair
    for sysid in (2, 3):
        exchanges[2].publish(told(sysid, 0))
    exchanges[1].gather(0)
    exchanges[1].gather(PERIOD_TICKS + DELAY_TICKS - 1)  # ends, though nobody has told anything of PERIOD_TICKS
    waiting = threading.Thread(target=lambda: exchanges[1].gather(2 * PERIOD_TICKS))
    waiting.start()
    exchanges[2].publish(told(2, 1))
    waiting.join(0.2)
    assert waiting.is_alive(), "for vehicle 3"
    exchanges[2].publish(told(3, 1))
    waiting.join(10)
    assert not waiting.is_alive()


def test_who_is_killed_as_scheduled_is_waited_for_until_then(pair: Pair) -> None:
    _, exchanges = pair
    last = KILLED_AT // PERIOD_TICKS
    for k in range(last + 10):
        exchanges[2].publish(told(2, k))
    for k in range(last + 1):
        exchanges[2].publish(told(3, k))
    exchanges[1].gather((last + 9) * PERIOD_TICKS)
    heard = exchanges[1].take(1)
    assert [intent.sequence for intent, _ in heard[3]] == list(range(last + 1))


def test_who_has_gone_is_waited_for_no_longer_and_stop_wakes_who_waits(pair: Pair) -> None:
    sessions, exchanges = pair
    sessions[2].close()
    exchanges[1].gather(10 * PERIOD_TICKS)
    waiting = threading.Thread(target=lambda: exchanges[2].gather(10 * PERIOD_TICKS))
    waiting.start()
    exchanges[2].stop()
    waiting.join(10)
    assert not waiting.is_alive()


def test_in_real_time_nobody_waits_and_an_intent_has_the_time_that_it_took() -> None:
    peers, _ = local_peers([1, 2])
    with ExitStack() as stack:
        sessions = {number: stack.enter_context(open_session(peer, real_time=True)) for number, peer in peers.items()}
        network = Network((1, 2), (), Channel(DELAY_TICKS))
        receiver = IntentExchange(sessions[1], SWARM, [1], network, lambda: 57.4)
        sender = IntentExchange(sessions[2], SWARM, [2], network, lambda: 50.0)
        token = sessions[2].liveliness().declare_token(alive_key(SWARM, 2))
        assert receiver.wait_for_others(10) == set()
        heard = receiver.take(1)
        while not heard:
            sender.publish(told(2, 2))
            receiver.gather(75)
            heard = receiver.take(1)
        assert set(heard[2]) == {(told(2, 2), 7)}
        del token
    for peer in peers.values():
        discard_sockets(peer)


def test_what_is_no_intent_is_dropped_counted_and_told(pair: Pair) -> None:
    sessions, exchanges = pair
    for payload in (b"nonsense", encode(told(3, 0))):
        sessions[2].put(intent_key(SWARM, 2), payload, priority=zenoh.Priority.REAL_TIME)
    for sysid in (2, 3):
        exchanges[2].publish(told(sysid, 0))
    exchanges[1].gather(PERIOD_TICKS)
    (report,) = exchanges[1].reports(1)
    assert (report.sender, report.receiver, sum(report.refused.values())) == (2, 1, 2)
    assert len(exchanges[1].complaints()) == 2
    assert [intent for intent, _ in exchanges[1].take(1)[2]] == [told(2, 0)]


def test_missing_vehicles_are_named_and_not_waited_for() -> None:
    peers, _ = local_peers([1])
    with open_session(peers[1]) as session:
        exchange = IntentExchange(session, SWARM, [1], NETWORK)
        assert exchange.wait_for_others(0.1) == {2, 3}
        exchange.gather(10 * PERIOD_TICKS)
    discard_sockets(peers[1])
