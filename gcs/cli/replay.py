"""`skein replay`: a recorded flight, once more, for any ground station."""

from pathlib import Path
from typing import Annotated

import typer

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption, finite

FilesArgument = Annotated[list[Path], typer.Argument(metavar="FILE...", help="Telemetry logs, one a vehicle or more.")]
ToOption = Annotated[
    str, typer.Option("--to", metavar="URL", help="udpout://HOST:PORT, tcp://HOST:PORT, tcpin://:PORT, ...")
]
PaceOption = Annotated[
    float,
    typer.Option("--speed", metavar="X", min=0.01, callback=finite, help="Recorded seconds a second."),
]


def replay(
    files: FilesArgument, to: ToOption = "udpout://127.0.0.1:14550", speed: PaceOption = 1.0, json: JsonOption = False
) -> None:
    """Play telemetry logs back to any ground station.

    With the pace of their stamps.

    Example: skein replay RUN/logs/*.tlog --speed 10
    """
    with exit_codes():
        import asyncio

        from gcs.cli import output
        from gcs.cli.progress import working
        from gcs.links.open_link import open_link
        from gcs.replay import read_replay
        from gcs.replay import replay as play

        with working("Reading", brief=True):
            messages = read_replay(files)
        lasts_s = messages[-1].time_s - messages[0].time_s

        async def main() -> int:
            link = await open_link(to)
            output.progress.print(f"Playing {lasts_s:.0f} s of {len(messages)} frames to {to}; Ctrl-C ends it")
            try:
                with working("Playing", brief=True) as bar:
                    return await play(messages, link, speed, told=lambda played_s: bar.show(played_s, lasts_s))
            finally:
                await link.close()

        frames = asyncio.run(main())
        if json:
            output.print_json({"frames": frames, "logged_s": lasts_s})
        else:
            output.out.print(f"{frames} frames sent")
