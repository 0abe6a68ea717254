"""The thread that serves the stations of a process's vehicles."""

import contextlib
import selectors
import threading
import time
from collections.abc import Iterator

from sitl.crew import Crew
from sitl.endpoint import Endpoint

TURN_S = 0.05
"""At least so often each face is told that time has passed; sooner when an upload has something overdue."""
SHORTEST_TURN_S = 0.001


@contextlib.contextmanager
def serving(crew: Crew) -> Iterator[None]:
    """Within this context a thread serves the crew's stations. Whoever fails at it leaves the crew.

    The sockets of all are closed at its end, those of who has left before it, soon.
    """
    stopped = threading.Event()
    everyone = list(crew.flying.values())
    thread = threading.Thread(target=_serve, args=(crew, everyone, stopped), name="mavlink")
    thread.start()
    try:
        yield
    finally:
        stopped.set()
        for endpoint in crew.flying.values():
            with contextlib.suppress(OSError):  # has just left, and its sockets are closed
                endpoint.links.stop_waiting()
        thread.join()


def _serve(crew: Crew, everyone: list[Endpoint], stopped: threading.Event) -> None:
    served = {endpoint.sysid: endpoint for endpoint in everyone}
    with selectors.DefaultSelector() as selector:
        for endpoint in everyone:
            selector.register(endpoint.links, selectors.EVENT_READ, endpoint)
        turn_at_s = time.monotonic()
        while not stopped.is_set():
            turned = [key.data for key, _ in selector.select(max(0.0, turn_at_s - time.monotonic()))]
            if (now_s := time.monotonic()) >= turn_at_s:
                turned = list(crew.flying.values())
                turn_at_s = now_s + TURN_S
            for endpoint in turned:
                _take_turn(crew, endpoint)
                turn_at_s = max(now_s + SHORTEST_TURN_S, min(turn_at_s, endpoint.face.deadline_s))
            for sysid in served.keys() - crew.flying.keys():
                selector.unregister(served[sysid].links)
                served.pop(sysid).links.close()
        for endpoint in served.values():
            endpoint.links.close()


def _take_turn(crew: Crew, endpoint: Endpoint) -> None:
    try:
        endpoint.links.poll(0.0)
        endpoint.face.on_tick()
    except Exception as error:  # whatever it was, the station is to know why it lost a vehicle
        crew.leave(endpoint, error)
