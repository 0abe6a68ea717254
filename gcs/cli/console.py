"""`skein console`: a swarm in three dimensions in the browser, live or recorded."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import DelayOption, OutOption, SeedOption, SpeedOption
from gcs.cli.station import DEFAULT_URL, KeyOption

if TYPE_CHECKING:
    import asyncio

    import viser

    from gcs.cli.planning import Source
    from gcs.flight import Cockpit
    from gcs.flight_record import FlightRecord

PORT = 8080
SPEED = 10.0

WhatArgument = Annotated[
    str | None,
    typer.Argument(
        metavar="[RUN|SCENARIO|FILE]",
        help="A flown run to look at; a planned run, or a scenario to plan, to fly. With --connect, what is around the "
        "vehicles. The scenario radars unless given.",
    ),
]
ConnectOption = Annotated[
    list[str] | None,
    typer.Option(
        "--connect",
        metavar="URL",
        help=f"Show vehicles that are there: links as of `skein status`, such as {DEFAULT_URL}.",
    ),
]
FlyOption = Annotated[bool, typer.Option("--fly", help="Fly a run that was flown already once more.")]
PortOption = Annotated[
    int, typer.Option("--port", metavar="P", min=0, max=65535, help="Of the page; the next free one if it is taken.")
]
HostOption = Annotated[
    str,
    typer.Option(
        "--host",
        metavar="ADDRESS",
        help="Address to listen on. Other than 127.0.0.1, browsers need the token in the address that is printed.",
    ),
]
OpenOption = Annotated[bool, typer.Option("--open", help="Open the page in this machine's browser.")]


def console(
    what: WhatArgument = None,
    connect: ConnectOption = None,
    signing_key: KeyOption = None,
    fly: FlyOption = False,
    speed: SpeedOption = SPEED,
    delay: DelayOption = None,
    seed: SeedOption = None,
    out: OutOption = None,
    port: PortOption = PORT,
    host: HostOption = "127.0.0.1",
    open_page: OpenOption = False,
) -> None:
    """Show a swarm in the browser, as it flies or as it flew, and steer it.

    Needs the extra `console`: pip install 'skein-gcs[console]'. Ctrl-C ends it; a flight is then reported on.

    Example: skein console vee --speed 5

    Example: skein console runs/first

    Example: skein console --connect udpin://127.0.0.1:14550
    """
    with exit_codes():
        _require_viser()
        from gcs.cli.planning import read_source
        from missions.errors import InputError

        if connect and (fly or delay is not None or seed is not None or out is not None or speed != SPEED):
            raise InputError("--connect: the vehicles fly as they do; leave --fly, --speed, --delay, --seed, --out out")
        web = Web(host, port, open_page)
        if connect:
            _watch(web, None if what is None else read_source(what), connect, signing_key)
        elif what is not None and (Path(what) / "metrics.json").is_file() and not fly:
            _show(web, Path(what))
        else:
            _fly(web, what or "radars", speed, delay, seed, out)


def _show(web: "Web", run: Path) -> None:
    """A recorded flight."""
    import asyncio

    from gcs.console.console import show_recording
    from gcs.report_page import read_flown_run
    from gcs.run_folder import RunFolder

    async def show() -> None:
        with web.serving() as server:
            await show_recording(server, flown, RunFolder(run).logs, until_interrupted())

    flown = read_flown_run(run)
    asyncio.run(show())


def _watch(web: "Web", source: "Source | None", urls: list[str], signing_key: Path | None) -> None:
    """Vehicles that are there."""
    import asyncio

    from gcs.cli import output
    from gcs.cli.station import HEARD_WAIT_S, signing_of
    from gcs.console.console import watch_fleet
    from gcs.fleet import Fleet
    from gcs.links.open_link import open_link
    from gcs.station_logs import station_logs

    async def watch() -> None:
        async with Fleet(station_logs(), signing=signing_of(signing_key), announce=output.progress.print) as fleet:
            for url in urls:
                fleet.attach(await open_link(url))
            output.progress.print(f"Listening on {', '.join(urls)}", markup=False)
            await fleet.discover(HEARD_WAIT_S)
            scenario, plan = (None, None) if source is None else (source.scenario, source.plan)
            with web.serving() as server:
                await watch_fleet(server, fleet, scenario, plan, until_interrupted())

    asyncio.run(watch())


def _fly(web: "Web", what: str, speed: float, delay: float | None, seed: int | None, out: Path | None) -> None:
    """Plan, if that has not been done; fly, and report."""
    import asyncio

    from gcs.cli import output
    from gcs.cli.flight_report import show_report
    from gcs.cli.options import clock_speed
    from gcs.cli.plan import plan_run
    from gcs.cli.planning import read_source
    from gcs.console.console import steering
    from gcs.flight import FlightOptions
    from gcs.flight import fly as fly_plan
    from gcs.report import write_report
    from gcs.run_folder import RunFolder
    from missions.errors import InputError

    source = read_source(what)
    if source.plan is None:
        run, scenario, plan = plan_run(what, out, seed)
    elif out is not None or seed is not None:
        raise InputError(f"{what}: is planned already; leave --out and --seed out")
    else:
        run, scenario, plan = RunFolder(Path(what)), source.scenario, source.plan
    delay_s = scenario.formation.delay_s if delay is None else delay
    options = FlightOptions(delay_s=delay_s, speed=clock_speed(speed, real_time=False))

    async def flight() -> "FlightRecord":
        with web.serving() as server:
            farewell = f"The flight has ended: `skein console {run.path}` shows it again, `skein report` tells of it"

            async def steer(cockpit: "Cockpit") -> None:  # an earlier Ctrl-C is no end of a flight, and interrupts
                await steering(server, scenario, plan, speed, until_interrupted(), farewell)(cockpit)

            return await fly_plan(scenario, plan, run, options, output.progress.print, lambda _: None, steer)

    record = asyncio.run(flight())
    output.progress.print("Computing figures of merit, drawing")
    show_report(write_report(run, scenario, plan, record), run, json=False)


@dataclass(frozen=True)
class Web:
    """Where the page is served, and whether this machine's browser is to open it."""

    host: str
    port: int
    open_page: bool

    @contextmanager
    def serving(self) -> "Iterator[viser.ViserServer]":
        """Within this context there is a server; its address is printed. Raises InputError when it cannot listen."""
        import secrets
        import webbrowser

        from gcs.cli import output
        from gcs.console.door import is_loopback
        from gcs.console.server import close_server, open_server

        token = None if is_loopback(self.host) else secrets.token_urlsafe(24)
        server = open_server(self.host, self.port, token)
        try:
            address = f"http://{self._name()}:{server.get_port()}/" + (f"?token={token}" if token else "")
            output.out.print(f"Console: {address}", soft_wrap=True, markup=False)
            if self.open_page:
                webbrowser.open(address)
            yield server
        finally:
            close_server(server)

    def _name(self) -> str:
        """What browsers call it: an address, or of all addresses this machine's name."""
        import socket

        if self.host in ("0.0.0.0", "::"):
            return socket.gethostname()
        return f"[{self.host}]" if ":" in self.host else self.host


def until_interrupted() -> "asyncio.Event":
    """An event that the first Ctrl-C sets, in the running loop; the second interrupts."""
    import asyncio
    import signal

    loop, until = asyncio.get_running_loop(), asyncio.Event()

    def end() -> None:
        loop.remove_signal_handler(signal.SIGINT)
        until.set()

    loop.add_signal_handler(signal.SIGINT, end)
    return until


def _require_viser() -> None:
    """Raises InputError without the extra."""
    from importlib.util import find_spec

    from missions.errors import InputError

    if find_spec("viser") is None:
        raise InputError("skein console needs viser: pip install 'skein-gcs[console]'")
