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
    return Clock(held=held, speed=speed)


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
    clock, answers = Clock(held=True, speed=1.0), list[bool]()
    clock.on_stop = lambda: stopped.append(True)
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


def live_clock(speed: float = 1.0) -> Clock:
    return Clock(held=True, speed=speed, real_time=True)


def test_clocks_that_are_released_to_one_moment_agree_however_late_the_word_comes() -> None:
    first, second = live_clock(20.0), live_clock(20.0)
    at_s = time.time()
    first.release(at_s)
    time.sleep(0.05)
    second.release(at_s)
    apart = abs(first.now_ticks() - second.now_ticks())
    assert first.now_ticks() >= 0.05 * 20.0 / TICK_S
    assert apart < 0.02 * 20.0 / TICK_S, "the wall's clock and the process's, asked one after the other"


def test_a_clock_in_real_time_is_never_early_and_makes_up_for_what_it_missed() -> None:
    clock = live_clock(10.0)
    start_s = time.time() + 0.05
    clock.release(start_s)
    for tick in range(20):
        assert clock.wait_for(tick)
        assert time.time() - start_s >= tick * TICK_S / 10.0 - 1e-3
    time.sleep(0.8)  # as if the process had been stopped: longer than a clock of lockstep makes up for
    ticks = 20
    while clock.now_ticks() >= ticks:
        assert clock.wait_for(ticks)
        ticks += 1
    assert ticks > 200, "no tick was left out, and the start is the same"
    assert clock.most_behind_s >= 0.7


def test_the_walls_clock_can_be_neither_held_nor_paced() -> None:
    clock = live_clock()
    with pytest.raises(ValueError, match="nobody holds"):
        clock.hold()
    with pytest.raises(ValueError, match="began with"):
        clock.pace(2.0)
    with pytest.raises(ValueError, match="moment"):
        clock.release(math.nan)


def test_a_second_release_does_not_move_the_start() -> None:
    clock = live_clock()
    clock.release(time.time() - 10.0)
    clock.release(time.time())
    assert clock.now_ticks() >= 10.0 / TICK_S


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


@pytest.mark.parametrize("held", [True, False])
def test_clocks_that_stand_for_a_moment_are_then_as_they_were(station: tuple[zenoh.Session, Clock], held: bool) -> None:
    session, clock = station
    clock.held = held
    with SwarmClock(session, "test", [4]).standing([4]):
        assert clock.held
    assert clock.held == held


@pytest.mark.parametrize("held", [True, False])
def test_whoever_does_not_answer_holds_nobody_up_and_starts_nobody(
    station: tuple[zenoh.Session, Clock], monkeypatch: pytest.MonkeyPatch, held: bool
) -> None:
    monkeypatch.setattr("gcs.swarm_clock.TIMEOUT_S", 0.3)
    session, clock = station
    clock.held = held
    swarm = SwarmClock(session, "test", [4])
    with pytest.raises(InputError, match=r"\[5\] did not answer"), swarm.standing([4, 5]):
        pass
    assert clock.held == held


def test_the_station_names_the_moment_of_the_start(station: tuple[zenoh.Session, Clock]) -> None:
    session, clock = station
    SwarmClock(session, "test", [4]).start([4], time.time() + 3600.0)
    assert not clock.held
    clock.speed = 1.0
    assert clock.now_ticks() == pytest.approx(-3600.0 / TICK_S, abs=60.0 / TICK_S)


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
