"""What a page sends to its browsers, counted at the WebSocket."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
import viser
import zstandard
from websockets.asyncio.client import ClientConnection, connect

from gcs.bench.page_viewer import aircraft_in, camera
from gcs.console.helm import Helm
from gcs.console.page import Page
from gcs.console.place import Place, place_of
from gcs.console.present import FRAME_S, present
from gcs.console.recording import Recording
from gcs.metrics import checks, measure
from gcs.rehearsal import RehearsalOptions, rehearse_plan
from gcs.report_page import FlownRun
from missions.errors import InputError
from missions.scenario import load_scenario
from planner.plan import plan
from sitl.formation.graph import edges

Places = npt.NDArray[np.float32]


@pytest.fixture(scope="module")
def nine() -> FlownRun:
    """The shipped V, flown by rehearsal."""
    scenario = load_scenario("vee")
    formation = plan(scenario)
    truths, record = rehearse_plan(scenario, formation, RehearsalOptions(7, 0.2))
    graph = edges(scenario.formation.graph, sorted(truths))
    metrics, series = measure(scenario, formation, truths, graph, record)
    return FlownRun("nine", "", scenario, formation, truths, metrics, series, checks(metrics, scenario))


@pytest.fixture(scope="module")
def place(nine: FlownRun) -> Place:
    return place_of(nine.scenario, nine.plan)


@asynccontextmanager
async def looking(server: viser.ViserServer) -> AsyncIterator[ClientConnection]:
    """A browser, as far as the server knows."""
    version: Any = f"viser-v{viser.__version__}"
    before = len(server.get_clients())
    address = f"ws://127.0.0.1:{server.get_port()}/"
    async with connect(address, subprotocols=[version], max_size=None, proxy=None, ping_interval=None) as socket:
        await socket.send(camera())
        while len(server.get_clients()) == before:
            await asyncio.sleep(0.01)
        yield socket


async def next_places(socket: ClientConnection) -> Places:
    """Where the aircraft are placed anew."""
    while True:
        data = await socket.recv()
        assert isinstance(data, bytes)
        for places in aircraft_in(data):
            return places


def text_in(data: bytes | str) -> str:
    """All that a frame says, but for its arrays."""
    assert isinstance(data, bytes)
    return zstandard.decompress(data[16 : 16 + int.from_bytes(data[8:16], "little")]).decode(errors="replace")


def test_each_frame_that_is_shown_arrives_at_every_browser_with_all_where_they_are(
    serve_pages: Any, nine: FlownRun, place: Place
) -> None:
    server = serve_pages()
    recording = Recording(nine)

    async def main() -> None:
        page = Page(server, place, recording, Helm())
        page.show(0.0)
        async with looking(server) as one, looking(server) as other:
            page.show(10.0)
            for frame in range(30):
                page.show(FRAME_S)
                wanted = place.chart.units(recording.advance(0.0).position_m)
                for socket in (one, other):
                    while not np.allclose(places := await next_places(socket), wanted, atol=1e-5):
                        assert frame == 0, "only what was shown before it came may still be on its way"
                    assert places.shape == (9, 3)

    asyncio.run(main())


def test_all_nine_are_placed_anew_thirty_times_a_second(serve_pages: Any, nine: FlownRun, place: Place) -> None:
    """In half a second, that is, in which the machine has nothing more urgent to do: it is waited for."""
    server = serve_pages()
    recording = Recording(nine)
    recording.speed = 0.5

    async def main() -> None:
        until = asyncio.Event()
        presented = asyncio.create_task(present(Page(server, place, recording, Helm()), recording, until))
        async with looking(server) as socket:
            clock = asyncio.get_running_loop().time
            last, arrived_s = await next_places(socket), [clock()]
            while len(arrived_s) < 16 or arrived_s[-1] - arrived_s[-16] > 0.6:
                places = await next_places(socket)
                assert places.shape == (9, 3)
                assert (places != last).any(axis=1).all(), "each of them has moved"
                last = places
                arrived_s.append(clock())
        until.set()
        await presented

    asyncio.run(main())


def test_a_browser_that_goes_disturbs_nobody_and_without_any_nothing_is_drawn(
    serve_pages: Any, nine: FlownRun, place: Place
) -> None:
    server = serve_pages()
    recording = Recording(nine)

    async def main() -> None:
        page = Page(server, place, recording, Helm())
        page.show(1.0)
        assert not server.get_clients()
        assert recording.t_s == 10.0, "it goes on unseen"
        async with looking(server) as one:
            async with looking(server):
                pass
            while len(server.get_clients()) > 1:
                await asyncio.sleep(0.01)
            page.show(FRAME_S)
            page.show(FRAME_S)
            assert (await next_places(one)).shape == (9, 3)
        while page.watched:  # until it is seen that nobody looks
            await asyncio.sleep(0.01)

    asyncio.run(main())


def test_what_goes_wrong_with_an_order_is_told_on_the_page_whatever_it_is(
    serve_pages: Any, nine: FlownRun, place: Place, capfd: pytest.CaptureFixture[str]
) -> None:
    server = serve_pages()

    async def refuse(error: Exception) -> None:
        raise error

    async def main() -> None:
        page = Page(server, place, Recording(nine), Helm())
        async with looking(server) as socket:
            for error in (InputError("<nobody> answers"), KeyError(7)):
                page.do("hold", refuse(error))
            told = ""
            while "hold: KeyError: 7" not in told:
                told += text_in(await socket.recv())
        assert "hold: &lt;nobody&gt; answers" in told

    asyncio.run(main())
    assert "KeyError: 7" in capfd.readouterr().err
