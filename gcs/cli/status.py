"""`skein status`: what vehicles do, at a glance."""

import asyncio

from gcs.cli.errors import exit_codes
from gcs.cli.options import JsonOption
from gcs.cli.station import (
    ConnectOption,
    KeyOption,
    StationOptions,
    VehicleOption,
    WaitOption,
    results_of,
    show_results,
)


def status(
    connect: ConnectOption = None,
    vehicle: VehicleOption = None,
    wait: WaitOption = None,
    signing_key: KeyOption = None,
    json: JsonOption = False,
) -> None:
    """Say of every vehicle that is heard where it is, what it does, and what it holds.

    Example: skein status --json
    """
    with exit_codes():
        from gcs.cli import output
        from gcs.cli.tables import status_table
        from gcs.vehicle_report import vehicle_report

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        reports = asyncio.run(results_of(options, options.sysids(), vehicle_report))
        if json:
            show_results("Status", reports, json)
        else:
            output.print_wide(status_table(reports))
