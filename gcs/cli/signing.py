"""`skein signing`: make a key, give it to vehicles, take it away."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption
from gcs.cli.station import (
    ConnectOption,
    KeyOption,
    StationOptions,
    VehicleOption,
    WaitOption,
    for_vehicles,
)
from gcs.cli.verbosity import Commands

if TYPE_CHECKING:
    from gcs.vehicle_link import VehicleLink

signing = Commands(name="signing", help="Make a signing key, give it to vehicles, take it away.", no_args_is_help=True)

NewFileArgument = Annotated[Path, typer.Argument(metavar="FILE", help="To be made; one that is there stays as it is.")]
FileArgument = Annotated[
    Path, typer.Argument(metavar="FILE", help="The new key: 32 bytes, raw, hexadecimal or base64; or a passphrase.")
]
OverNetworkOption = Annotated[
    bool,
    typer.Option("--over-network", help="Send the key, in clear, to other machines too: only on a network you trust."),
]


@signing.command("new")
def new(file: NewFileArgument, json: JsonOption = False) -> None:
    """Make a random key, in a file that nobody else can read.

    Example: skein signing new swarm.key
    """
    with exit_codes():
        from gcs.cli import output
        from gcs.signing_key import make_signing_key

        make_signing_key(file)
        if json:
            output.print_json({"file": str(file)})
        else:
            output.out.print(f"{file}: a new key; keep a copy, for vehicles hear nobody without it", markup=False)


@signing.command("set")
def set_key(
    file: FileArgument,
    over_network: OverNetworkOption = False,
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Give vehicles a key, and hear them sign with it; from then on they hear only who has it, with --signing-key.

    The key goes to the vehicle in clear: use a cable, or this machine's own network. A vehicle that has a key already
    takes another only from who has the old one (--signing-key), and none while it is armed.

    Example: skein signing set swarm.key --connect serial:///dev/ttyACM0:115200
    """
    with exit_codes():
        from gcs.cli import output
        from gcs.signing_key import read_signing_key
        from gcs.transfers.setup_signing import setup_signing
        from sitl.services.signing import Signing

        fresh = Signing(key=read_signing_key(file, output.progress.print))

        def check(vehicles: "Sequence[VehicleLink]") -> None:
            if not over_network:
                _require_local(vehicles)

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        words = "signs with the key"
        for_vehicles(options, "Signing", lambda one: setup_signing(one, fresh), check=check, words=lambda _: words)


@signing.command("off")
def off(
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Take the key away from vehicles, and hear that they no longer sign; they want the old one with --signing-key.

    Example: skein signing off --signing-key swarm.key --vehicle 3
    """
    with exit_codes():
        from gcs.transfers.setup_signing import setup_signing
        from sitl.services.signing import Signing

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        words = "does not sign"
        for_vehicles(options, "Signing", lambda one: setup_signing(one, Signing()), words=lambda _: words)


def _require_local(vehicles: "Sequence[VehicleLink]") -> None:
    """Raises InputError when a key would cross a network."""
    from missions.errors import InputError

    for one in vehicles:
        if not one.peer.is_local:
            raise InputError(
                f"{one}: is at {one.peer}, and the key would cross the network in clear; give it over a cable, or say "
                "--over-network if you trust the network"
            )
