"""Endpoints' faces on real sockets, for the station to talk to."""

import contextlib
import re
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from missions.frame import LocalFrame
from missions.scenario import read_scenario_text
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


@pytest.fixture(scope="session")
def short_scenario(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three aircraft of the shipped V on two legs of 1.2 km with a turn of 30 degrees: some 86 s of flight."""
    text, _ = read_scenario_text("vee")
    head, *vehicles = re.split(r"(?=\[\[vehicles\]\])", text)
    last, rest = vehicles[-1].split("# Aerosonde", 1)
    del last
    head = re.sub(
        r"points = \[.*?\n\]",
        "points = [[0.0, 0.0, 0.0], [1200.0, 0.0, 80.0], [2239.0, 600.0, 80.0]]",
        head,
        flags=re.S,
    )
    head = head.replace('name = "vee"', 'name = "short"')
    file = tmp_path_factory.mktemp("scenario") / "short.toml"
    file.write_text(head + "".join(vehicles[:3]) + "# Aerosonde" + rest)
    return file
