"""The clock: held, released, paced, stopped; and its queryable on a real session."""

import json
import math
import threading
import time
from collections.abc import Iterator

import pytest
import zenoh

from gcs.swarm_clock import SwarmClock
from missions.errors import InputError
from sitl.clock import Clock, serve_clock
from sitl.ticks import TICK_S, delay_ticks
from sitl.zenoh_session import alive_key, clock_key, discard_sockets, local_peers, open_session


def make_clock(held: bool = False, speed: float = math.inf) -> Clock:
    return Clock(held=held, speed=speed, on_stop=lambda: None)


def test_a_held_clock_lets_nothing_begin_until_it_is_released() -> None:
    clock, begun = make_clock(held=True), threading.Event()
    thread = threading.Thread(target=lambda: clock.wait_for(0) and begun.set())
    thread.start()
    assert not begun.wait(0.1)
    clock.release()
    assert begun.wait(10)
    thread.join()


def test_stopping_ends_waiting_and_tells_it() -> None:
    stopped: list[bool] = []
    clock, answers = Clock(held=True, speed=1.0, on_stop=lambda: stopped.append(True)), list[bool]()
    thread = threading.Thread(target=lambda: answers.append(clock.wait_for(0)))
    thread.start()
    clock.stop()
    clock.stop()
    thread.join(10)
    assert answers == [False]
    assert stopped == [True]


def test_a_paced_clock_is_never_early() -> None:
    clock, start = make_clock(speed=10.0), time.monotonic()
    for tick in range(50):
        assert clock.wait_for(tick)
        assert time.monotonic() - start >= tick * TICK_S / 10.0 - 1e-6


def test_a_free_clock_does_not_wait() -> None:
    clock = make_clock()
    assert all(clock.wait_for(tick) for tick in range(10_000))


@pytest.mark.parametrize(("delay_s", "ticks"), [(0.0, 1), (0.04, 1), (0.041, 2), (0.2, 5), (0.2001, 6), (1.0, 25)])
def test_delays_are_whole_ticks_rounded_up_at_least_one(delay_s: float, ticks: int) -> None:
    assert delay_ticks(delay_s) == ticks


@pytest.fixture
def station() -> Iterator[tuple[zenoh.Session, Clock]]:
    """A station's session beside a vehicle's that serves a held clock."""
    peers, station_peer = local_peers([4])
    clock = make_clock(held=True)
    with open_session(peers[4]) as vehicle, open_session(station_peer) as session:
        serve_clock(vehicle, "test", lambda: [4], clock)
        alive = vehicle.liveliness().declare_token(alive_key("test", 4))
        yield session, clock
        alive.undeclare()
    discard_sockets(peers[4])


def test_the_station_releases_paces_holds_and_stops(station: tuple[zenoh.Session, Clock]) -> None:
    session, clock = station
    swarm = SwarmClock(session, "test", [4])
    swarm.release([4])
    assert not clock.held
    swarm.pace(2.5, [4])
    assert clock.speed == 2.5
    swarm.pace(0, [4])
    assert math.isinf(clock.speed)
    swarm.hold([4])
    assert clock.held
    swarm.stop([4])
    assert clock.stopped


def test_vehicles_that_do_not_answer_are_named(
    station: tuple[zenoh.Session, Clock], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gcs.swarm_clock.TIMEOUT_S", 0.3)
    clock = SwarmClock(station[0], "test", [4])
    with pytest.raises(InputError, match=r"\[5\] did not answer"):
        clock.release([4, 5])


def test_vehicles_that_cannot_be_reached_are_named(
    station: tuple[zenoh.Session, Clock], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gcs.swarm_clock.TIMEOUT_S", 0.3)
    with pytest.raises(InputError, match=r"\[6\] cannot be reached"):
        SwarmClock(station[0], "test", [4, 6])


@pytest.mark.parametrize("request_", [b"", b"[]", b'{"do": "explode"}', b'{"speed": -1}', b'{"speed": "x"}', b"\xff"])
def test_nonsense_is_answered_with_an_error_and_changes_nothing(
    station: tuple[zenoh.Session, Clock], request_: bytes
) -> None:
    session, clock = station
    SwarmClock(session, "test", [4])
    replies = list(session.get(clock_key("test"), payload=request_))
    assert [reply.ok for reply in replies] == [None]
    assert b"vehicle 4" in replies[0].err.payload.to_bytes()
    assert clock.held
    assert math.isinf(clock.speed)


def test_the_state_can_be_asked(station: tuple[zenoh.Session, Clock]) -> None:
    session, _ = station
    SwarmClock(session, "test", [4])
    (reply,) = session.get(clock_key("test"))
    assert json.loads(reply.ok.payload.to_bytes()) == {
        "sysid": 4,
        "tick": 0,
        "held": True,
        "speed": 0.0,
        "stopped": False,
    }
