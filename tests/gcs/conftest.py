"""Endpoints' faces on real sockets, for the station to talk to."""

import contextlib
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from missions.frame import LocalFrame
from sitl.services.face import MavlinkFace
from sitl.services.links import StationLinks

Serve = Callable[..., StationLinks]


@pytest.fixture
def serve(frame: LocalFrame) -> Iterator[Serve]:
    """Serves a fake vehicle's face in a thread of its own, to stations over UDP and whoever comes over TCP."""
    with contextlib.ExitStack() as stack:

        def start(vehicle: Any, *stations: tuple[str, int]) -> StationLinks:
            links = stack.enter_context(contextlib.closing(StationLinks(0, stations)))
            face = MavlinkFace(vehicle, frame, links.send, time.monotonic, {"SYSID_THISMAV": (float(vehicle.sysid), 4)})
            links.attach(face)
            stopped = threading.Event()
            thread = threading.Thread(target=links.run, args=(stopped,))

            def stop() -> None:
                stopped.set()
                links.stop_waiting()
                thread.join()

            thread.start()
            stack.callback(stop)
            face.on_simulated_tick(vehicle.snapshot())
            return links

        yield start
