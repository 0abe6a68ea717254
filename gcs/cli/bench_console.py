"""`skein bench --console`: what a console costs while it shows nine vehicles, and two hundred."""

import asyncio
from dataclasses import asdict
from typing import TYPE_CHECKING

from rich.table import Table

if TYPE_CHECKING:
    from gcs.bench.console_load import ConsoleLoad

SECONDS, QUICK_SECONDS = 20.0, 3.0
MANY = 200


def bench_console(quick: bool, json: bool) -> None:
    """Measure and print."""
    from gcs.bench.console_load import many_connected, nine_flying
    from gcs.cli import output

    async def measure() -> "list[ConsoleLoad]":
        seconds = QUICK_SECONDS if quick else SECONDS
        output.progress.print("Nine in flight")
        nine = await nine_flying(seconds)
        output.progress.print(f"{MANY} in flight, heard over MAVLink")
        return [nine, await many_connected(MANY, seconds)]

    loads = asyncio.run(measure())
    if json:
        output.print_json([asdict(load) for load in loads])
        return
    table = Table(title="A console that one browser looks at", title_justify="left")
    for heading in ("vehicles", "placed a second", "poses a second", "kB a second", "of a core"):
        table.add_column(heading, justify="right")
    for load in loads:
        table.add_row(
            str(load.vehicles), f"{load.frames_hz:.1f}", f"{load.poses_hz:.0f}", f"{load.bytes_s / 1000:.0f}",
            f"{100 * load.core:.0f} %",
        )  # fmt: skip
    output.out.print(table)
