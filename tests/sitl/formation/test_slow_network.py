"""Corrections over a network that takes its time: a relay before the router holds all that is said for a while."""

import contextlib
import queue
import socket
import threading
import time
from collections.abc import Callable, Iterator

import pytest

from sitl.formation.correction import Correction
from sitl.formation.live_exchange import LiveExchange
from sitl.formation.network import complete
from sitl.ticks import TICK_S
from sitl.zenoh_network import ZenohNetwork, vehicle_name
from sitl.zenoh_session import alive_key, open_session

SWARM = "slow"
HELD_S = 0.1
DELAY_TICKS = 2
SAMPLES = 10


def passed_on(source: socket.socket, sink: socket.socket) -> None:
    """Start to pass on what comes, each piece HELD_S later."""
    line: queue.SimpleQueue[tuple[float, bytes]] = queue.SimpleQueue()

    def take() -> None:
        with contextlib.suppress(OSError):
            while data := source.recv(65536):
                line.put((time.monotonic() + HELD_S, data))
        line.put((0.0, b""))

    def give() -> None:
        with contextlib.suppress(OSError):
            while (piece := line.get())[1]:
                time.sleep(max(0.0, piece[0] - time.monotonic()))
                sink.sendall(piece[1])
            sink.shutdown(socket.SHUT_WR)

    for work in (take, give):
        threading.Thread(target=work, daemon=True).start()


@contextlib.contextmanager
def relay(port: int) -> Iterator[int]:
    """The port of a relay to a port of this machine."""
    with contextlib.ExitStack() as ends, socket.create_server(("127.0.0.1", 0)) as server:

        def serve() -> None:
            with contextlib.suppress(OSError):
                while True:
                    client = ends.enter_context(contextlib.closing(server.accept()[0]))
                    router = ends.enter_context(contextlib.closing(socket.create_connection(("127.0.0.1", port))))
                    passed_on(client, router)
                    passed_on(router, client)

        threading.Thread(target=serve, daemon=True).start()
        yield server.getsockname()[1]
        server.shutdown(socket.SHUT_RDWR)


@pytest.fixture
def router(free_port: Callable[[], int]) -> Iterator[int]:
    """The port of a router."""
    port = free_port()
    with open_session(ZenohNetwork(SWARM, f"tcp/127.0.0.1:{port}").server(), real_time=True):
        yield port


def test_what_the_network_takes_is_measured_and_the_injected_delay_comes_on_top(router: int) -> None:
    start_s = time.monotonic()

    def now_ticks() -> float:
        return (time.monotonic() - start_s) / TICK_S

    graph = complete([1, 2], [(1, 2)], DELAY_TICKS)
    with relay(router) as relayed, contextlib.ExitStack() as stack:
        ways = {1: ZenohNetwork(SWARM, f"tcp/127.0.0.1:{router}"), 2: ZenohNetwork(SWARM, f"tcp/127.0.0.1:{relayed}")}
        sessions = {i: stack.enter_context(open_session(ways[i].client(vehicle_name(i)), real_time=True)) for i in ways}
        exchanges = {
            i: LiveExchange(sessions[i], SWARM, {i: {3 - i: DELAY_TICKS}}, graph, 7, now_ticks) for i in sessions
        }
        tokens = [sessions[i].liveliness().declare_token(alive_key(SWARM, i)) for i in sessions]
        assert [exchange.wait_for_neighbours(20) for exchange in exchanges.values()] == [set(), set()]
        first = int(now_ticks()) + 1
        tick = first
        while min(exchange.reports(i)[0].heard for i, exchange in exchanges.items()) < SAMPLES:
            assert tick < first + 1000, "nothing was heard"
            time.sleep(max(0.0, (tick - now_ticks()) * TICK_S))
            for i, exchange in exchanges.items():
                exchange.publish(Correction(i, tick, tick, True, 0.0, 0.0))
                exchange.gather(tick)
                newest = exchange.heard_by(i).get(3 - i)
                assert newest is None or (tick - newest.tick) * TICK_S >= HELD_S - TICK_S + DELAY_TICKS * TICK_S
            tick += 1
        for i, exchange in exchanges.items():
            (report,) = exchange.reports(i)
            assert report.late == report.heard, "lockstep would have waited for each"
            assert report.delay_mean_s is not None
            assert report.delay_mean_s >= HELD_S + DELAY_TICKS * TICK_S
        del tokens
