"""Corrections over real Zenoh sessions: waited for in lockstep, and no longer when a neighbour has gone."""

import threading
from collections.abc import Iterator
from contextlib import ExitStack

import pytest
import zenoh

from sitl.formation.correction import Correction, encode
from sitl.formation.exchange import Exchange
from sitl.zenoh_session import alive_key, correction_key, discard_sockets, local_peers, open_session

SWARM = "test"


def sample(sysid: int, tick: int) -> Correction:
    return Correction(sysid, tick, tick, True, 0.1 * tick, -0.2)


@pytest.fixture
def pair() -> Iterator[tuple[dict[int, zenoh.Session], dict[int, Exchange]]]:
    """Vehicles 1 and 2, each other's neighbours."""
    peers, _ = local_peers([1, 2])
    with ExitStack() as stack:
        sessions = {sysid: stack.enter_context(open_session(peer)) for sysid, peer in peers.items()}
        exchanges = {sysid: Exchange(sessions[sysid], SWARM, {sysid: {3 - sysid: 0}}) for sysid in peers}
        tokens = [sessions[sysid].liveliness().declare_token(alive_key(SWARM, sysid)) for sysid in peers]
        assert exchanges[1].wait_for_neighbours(10) == set()
        assert exchanges[2].wait_for_neighbours(10) == set()
        yield sessions, exchanges
        del tokens
    for peer in peers.values():
        discard_sockets(peer)


def gathered(exchange: Exchange, sysid: int, tick: int) -> dict[int, Correction]:
    """What a vehicle hears at a tick, without delay."""
    exchange.gather(tick)
    return exchange.heard_by(sysid)


Pair = tuple[dict[int, zenoh.Session], dict[int, Exchange]]


def test_each_hears_the_other_tick_by_tick(pair: Pair) -> None:
    _, exchanges = pair
    for tick in range(200):
        for sysid, exchange in exchanges.items():
            exchange.publish(sample(sysid, tick), now=True)
        assert gathered(exchanges[1], 1, tick) == {2: sample(2, tick)}
        assert gathered(exchanges[2], 2, tick) == {1: sample(1, tick)}


def test_several_samples_may_share_a_message(pair: Pair) -> None:
    _, exchanges = pair
    for tick in range(5):
        exchanges[2].publish(sample(2, tick), now=tick == 4)
    assert [gathered(exchanges[1], 1, tick) for tick in range(5)] == [{2: sample(2, tick)} for tick in range(5)]


def test_a_sample_that_is_not_there_yet_is_waited_for(pair: Pair) -> None:
    _, exchanges = pair
    heard: list[dict[int, Correction]] = []
    waiting = threading.Thread(target=lambda: heard.append(gathered(exchanges[1], 1, 7)))
    waiting.start()
    waiting.join(0.2)
    assert waiting.is_alive()
    exchanges[2].publish(sample(2, 7), now=True)
    waiting.join(10)
    assert heard == [{2: sample(2, 7)}]


def test_who_has_gone_is_waited_for_no_longer_but_its_last_words_count(pair: Pair) -> None:
    sessions, exchanges = pair
    exchanges[2].publish(sample(2, 0), now=True)
    sessions[2].close()
    assert gathered(exchanges[1], 1, 0) == {2: sample(2, 0)}
    assert gathered(exchanges[1], 1, 1) == {}
    assert exchanges[1].gone == {2}


def test_stop_wakes_who_waits(pair: Pair) -> None:
    _, exchanges = pair
    waiting = threading.Thread(target=lambda: exchanges[1].gather(0))
    waiting.start()
    exchanges[1].stop()
    waiting.join(10)
    assert not waiting.is_alive()


@pytest.mark.parametrize("payload", [b"", b"nonsense", b"\xff" * 40])
def test_payloads_that_are_no_samples_are_counted_and_dropped(pair: Pair, payload: bytes) -> None:
    sessions, exchanges = pair
    sessions[2].put(correction_key(SWARM, 2), payload, priority=zenoh.Priority.REAL_TIME)
    exchanges[2].publish(sample(2, 0), now=True)
    assert gathered(exchanges[1], 1, 0) == {2: sample(2, 0)}
    assert sum(exchanges[1].reports(1)[0].refused.values()) == 1


def test_a_sample_in_anothers_name_is_dropped(pair: Pair) -> None:
    sessions, exchanges = pair
    sessions[2].put(correction_key(SWARM, 2), encode(sample(9, 0)), priority=zenoh.Priority.REAL_TIME)
    exchanges[2].publish(sample(2, 0), now=True)
    assert gathered(exchanges[1], 1, 0) == {2: sample(2, 0)}
    assert sum(exchanges[1].reports(1)[0].refused.values()) == 1


def test_missing_neighbours_are_named() -> None:
    peers, _ = local_peers([1])
    with open_session(peers[1]) as session:
        assert Exchange(session, SWARM, {1: {2: 0, 3: 0}}).wait_for_neighbours(0.1) == {2, 3}
    discard_sockets(peers[1])


def test_neighbours_in_one_process_hear_each_other_without_zenoh() -> None:
    peers, _ = local_peers([1])
    with open_session(peers[1]) as session:
        together = Exchange(session, SWARM, {1: {2: 0}, 2: {1: 0}})
        assert together.neighbours == ()
        assert together.wait_for_neighbours(0.0) == set()
        for tick in range(3):
            together.publish(sample(1, tick), now=False)
            together.publish(sample(2, tick), now=False)
        for tick in range(3):
            assert gathered(together, 1, tick) == {2: sample(2, tick)}
            assert gathered(together, 2, tick) == {1: sample(1, tick)}
    discard_sockets(peers[1])


def test_who_comes_back_is_waited_for_again_and_hears_where_the_others_are() -> None:
    peers, _ = local_peers([1, 2])
    with open_session(peers[1]) as session:
        stayed = Exchange(session, SWARM, {1: {2: 0}})
        token = session.liveliness().declare_token(alive_key(SWARM, 1))
        with open_session(peers[2]) as first_life:
            first_token = first_life.liveliness().declare_token(alive_key(SWARM, 2))
            assert stayed.wait_for_neighbours(10) == set()
            first_token.undeclare()
            stayed.publish(sample(1, 100), now=True)
            assert gathered(stayed, 1, 95) == {}
        heard: list[dict[int, Correction]] = []
        waiting = threading.Thread(target=lambda: heard.append(heard_on_return(stayed, 99)))
        waiting.start()
        with open_session(peers[2]) as second_life:
            back = Exchange(second_life, SWARM, {2: {1: 0}})
            second_token = second_life.liveliness().declare_token(alive_key(SWARM, 2))
            assert back.wait_for_neighbours(10) == set()
            assert gathered(back, 2, 94) == {}, "it is told where the other is, instead of waiting for what is over"
            back.publish(sample(2, 99), now=True)
            waiting.join(10)
            assert heard == [{2: sample(2, 99)}]
            second_token.undeclare()
        token.undeclare()
    for peer in peers.values():
        discard_sockets(peer)


def heard_on_return(exchange: Exchange, tick: int) -> dict[int, Correction]:
    """What a vehicle hears of a tick that has flown on alone and finds its neighbour back."""
    while exchange.gone:
        exchange.gather(tick - 1)
    return gathered(exchange, 1, tick)


def test_each_link_has_a_delay_of_its_own_and_who_falls_silent_by_schedule_is_not_waited_for() -> None:
    peers, _ = local_peers([1])
    with open_session(peers[1]) as session:
        together = Exchange(session, SWARM, {1: {2: 3}, 2: {1: 1}, 3: {2: 2}})
        for tick in range(6):
            for sysid in (1, 2, 3):
                together.publish(sample(sysid, tick), now=False)
        for tick in range(6):
            together.gather(tick)
            for sysid, other, delay in ((1, 2, 3), (2, 1, 1), (3, 2, 2)):
                expected = {other: sample(other, tick - delay)} if tick >= delay else {}
                assert together.heard_by(sysid) == expected
        waited_for = Exchange(session, SWARM, {1: {2: 1}}, last_ticks={2: -1})
        assert gathered(waited_for, 1, 1000) == {}
    discard_sockets(peers[1])
