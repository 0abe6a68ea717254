"""`skein router`: the Zenoh router at which a swarm of several machines meets."""

from pathlib import Path
from typing import Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption

FileArgument = Annotated[Path, typer.Argument(metavar="FILE", help="How the swarm meets; see docs/real-time.md.")]


def router(file: FileArgument, json: JsonOption = False) -> None:
    """Run the router of a swarm on several machines, until Ctrl-C. With certificates, each vehicle speaks for itself
    alone, and strangers neither hear nor are heard.

    Example: skein router field.toml
    """
    with exit_codes():
        import threading

        from gcs.cli import output
        from gcs.zenoh_file import read_zenoh_file
        from sitl.zenoh_session import open_session

        network = read_zenoh_file(file)
        with open_session(network.server(), real_time=True):
            if json:
                output.print_json_line({"swarm": network.swarm, "router": network.router})
            else:
                output.out.print(f"Router of {network.swarm} at {network.router}; Ctrl-C ends it.")
            threading.Event().wait()
