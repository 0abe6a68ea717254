"""What the commands of an operator share: which links, which vehicles, and how results are shown."""

from collections.abc import Callable, Coroutine, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple, TypeAlias

import typer

from gcs.cli.errors import FELL_SHORT
from gcs.cli.options import finite

if TYPE_CHECKING:
    from gcs.fleet import Fleet
    from gcs.vehicle_link import VehicleLink
    from sitl.services.signing import Signing

Work: TypeAlias = "Callable[[VehicleLink], Coroutine[Any, Any, Any]]"
Check: TypeAlias = "Callable[[list[VehicleLink]], None]"
DEFAULT_URL = "udpin://127.0.0.1:14550"
NAMED_WAIT_S = 10.0
HEARD_WAIT_S = 2.2
"""Two heartbeats and a little: who is there is heard within it."""

ConnectOption = Annotated[
    list[str] | None,
    typer.Option(
        "--connect",
        metavar="URL",
        help=f"udpin://HOST:PORT, udpout://HOST:PORT, tcp://HOST:PORT or serial://DEVICE:BAUD; {DEFAULT_URL} unless"
        " given; may be given several times.",
    ),
]
VehicleOption = Annotated[
    str | None,
    typer.Option("--vehicle", metavar="IDS", help="System ids, such as 3 or 1,4-6; all that are heard unless given."),
]
WaitOption = Annotated[
    float | None,
    typer.Option(
        "--wait",
        metavar="S",
        min=0.1,
        callback=finite,
        help=f"Seconds to wait for heartbeats: {NAMED_WAIT_S:g} for the vehicles named, {HEARD_WAIT_S:g} for whoever is"
        " there.",
    ),
]
KeyOption = Annotated[
    Path | None, typer.Option("--signing-key", metavar="FILE", help="Sign with this key, and hear only who does.")
]
SIGNS = "signs what it sends, and may hear only who has its key: --signing-key FILE"
_LAST_SYSID = 255


class StationOptions(NamedTuple):
    """What an operator's command was given: links, vehicles, patience, key, and how to print."""

    connect: list[str] | None
    vehicle: str | None
    wait_s: float | None
    signing_key: Path | None
    json: bool

    def sysids(self) -> list[int] | None:
        """The vehicles chosen; None for all. Raises InputError."""
        return chosen_sysids(self.vehicle)


def chosen_sysids(text: str | None) -> list[int] | None:
    """The system ids in "1,4-6"; None for all. Raises InputError."""
    from missions.errors import InputError

    if text is None:
        return None
    sysids: list[int] = []
    for part in text.split(","):
        first, dash, last = part.partition("-")
        try:
            ids = range(int(first), int(last if dash else first) + 1)
        except ValueError:
            raise InputError(f"--vehicle {text}: {part!r} is no system id; write 3 or 1,4-6") from None
        if not ids or ids[0] < 1 or ids[-1] > _LAST_SYSID:
            raise InputError(f"--vehicle {text}: {part!r}: system ids are 1 to {_LAST_SYSID}")
        sysids += [sysid for sysid in ids if sysid not in sysids]
    return sysids


def for_vehicles(
    options: StationOptions,
    title: str,
    work: "Work",
    *,
    sysids: Sequence[int] | None = None,
    check: "Check | None" = None,
    words: Callable[[Any], str] = str,
    whoever: bool = False,
) -> None:
    """Find the vehicles, do some work with all of them at once, and print what came of it; exit with 1 if one failed.

    Args:
        options: the command's.
        title: of the table.
        work: with one vehicle.
        sysids: the vehicles, where the options do not say it.
        check: called with the vehicles before anything is done.
        words: what the table says of a result; JSON has the result as it is.
        whoever: do it with each vehicle as soon as it is heard, and count one that is missing as failed; otherwise
            nothing is done before all are there, each with a system id of its own.

    Raises:
        InputError: a link cannot be opened, nobody is heard, or a vehicle is missing where all must be there.
    """
    import asyncio

    wanted = options.sysids() if sysids is None else sysids
    show_results(title, asyncio.run(results_of(options, wanted, work, check, whoever)), options.json, words)


async def results_of(
    options: StationOptions,
    sysids: Sequence[int] | None,
    work: "Work",
    check: "Check | None" = None,
    whoever: bool = False,
) -> dict[int, Any]:
    """What came of some work with each vehicle, by system id: a result, or an error in its place. See for_vehicles."""
    from gcs.cli import output
    from gcs.cli.progress import working
    from gcs.fleet import Fleet
    from gcs.links.open_link import open_link
    from gcs.station_logs import station_logs
    from gcs.transfers.for_all import for_all

    signing = signing_of(options.signing_key)
    async with Fleet(station_logs(), signing=signing, announce=output.progress.print) as fleet:
        for url in options.connect or [DEFAULT_URL]:
            fleet.attach(await open_link(url))
        if sysids is None:
            with working("Listening for vehicles", brief=True):
                sysids = [one.sysid for one in await fleet.discover(options.wait_s or HEARD_WAIT_S)]
        patience_s = options.wait_s or NAMED_WAIT_S
        with working("Waiting for vehicles", count=len(sysids), brief=True) as bar:

            async def shown(one: "VehicleLink") -> Any:
                try:
                    return await work(one)
                finally:
                    bar.advance("Vehicles done")

            if whoever:
                results = await _with_whoever_is_there(fleet, sysids, patience_s, shown)
            else:
                vehicles = await fleet.wait_for(sysids, patience_s)
                await fleet.hear_out()
                fleet.check()
                if check is not None:
                    check(vehicles)
                bar.show(0, len(sysids), "Vehicles done")
                results = await for_all(vehicles, shown)
                fleet.check()
        for line in fleet.complaints():
            output.progress.print(line, soft_wrap=True)
        if options.signing_key is None:
            _advise_key(fleet, results)
        return results


async def _with_whoever_is_there(
    fleet: "Fleet", sysids: Sequence[int], patience_s: float, work: "Work"
) -> dict[int, Any]:
    import asyncio

    from gcs.transfers.errors import TransferError
    from missions.errors import InputError

    async def one(sysid: int) -> Any:
        try:
            return await work(await fleet.hear(sysid, patience_s))
        except (InputError, TransferError) as error:
            return error

    results = dict(zip(sysids, await asyncio.gather(*map(one, sysids)), strict=True))
    await fleet.hear_out()
    for sysid, result in results.items():
        if (doubled := fleet.doubled(sysid)) is not None:
            came = f"{result}; {doubled}" if isinstance(result, Exception) else doubled
            results[sysid] = TransferError(f"{came}; only one of them was reached")
    return results


def _advise_key(fleet: "Fleet", results: dict[int, Any]) -> None:
    """Say of those that failed that they sign, which may be why: the station has no key."""
    from gcs.cli import output

    for sysid, result in results.items():
        vehicle = fleet.vehicles.get(sysid)
        if isinstance(result, Exception) and vehicle is not None and vehicle.signs:
            output.progress.print(f"{vehicle}: {SIGNS}", soft_wrap=True)


def signing_of(key_file: Path | None) -> "Signing":
    """How the station signs: with the key in a file, or not. Raises InputError."""
    from gcs.cli import output
    from gcs.signing_key import read_signing_key
    from sitl.services.signing import Signing

    return Signing(key=None if key_file is None else read_signing_key(key_file, output.progress.print))


def show_results(title: str, results: dict[int, Any], json: bool, words: Callable[[Any], str] = str) -> None:
    """Print what came of each vehicle; exit with 1 if one of them failed."""
    from gcs.cli import output
    from gcs.cli.tables import results_table

    failed = {sysid: str(result) for sysid, result in results.items() if isinstance(result, Exception)}
    if json:
        rows = [
            {"sysid": sysid, "ok": False, "error": failed[sysid]}
            if sysid in failed
            else {"sysid": sysid, "ok": True, "result": result}
            for sysid, result in results.items()
        ]
        output.print_json({"vehicles": rows})
    else:
        done = {sysid: words(result) for sysid, result in results.items() if sysid not in failed}
        output.print_wide(results_table(title, list(results), done, failed))
    if failed:
        raise SystemExit(FELL_SHORT)


def require_one(vehicles: "Sequence[VehicleLink]", what: str) -> None:
    """Raises InputError, with what is likely a mistake, when there are several vehicles."""
    from missions.errors import InputError

    if len(vehicles) > 1:
        heard = ", ".join(str(one.sysid) for one in vehicles)
        raise InputError(f"{what} for several vehicles ({heard}) is likely a mistake; choose one with --vehicle")
