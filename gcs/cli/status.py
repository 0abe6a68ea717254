"""`skein status`: what vehicles do, at a glance."""

from gcs.cli.errors import FELL_SHORT, exit_codes
from gcs.cli.options import JsonOption
from gcs.cli.station import (
    SIGNS,
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
    """Say what each vehicle does.

    Of every one that is heard: where it is, what it does, and what it holds.

    Of one that is missing or does not answer, it says that, and exits with 1.

    Example: skein status --json
    """
    with exit_codes():
        import asyncio

        from gcs.cli import output
        from gcs.cli.tables import status_table
        from gcs.vehicle_report import vehicle_report

        options = StationOptions(connect, vehicle, wait, signing_key, json)
        reports = asyncio.run(results_of(options, options.sysids(), vehicle_report, whoever=True))
        deaf = {sysid: one for sysid, one in reports.items() if not isinstance(one, Exception) and not one["answers"]}
        if json:
            show_results("Status", reports, json)
        else:
            output.print_wide(status_table(reports))
            lines = [str(one) for one in reports.values() if isinstance(one, Exception)]
            for sysid, report in deaf.items():
                advice = f"; it {SIGNS}" if report["signs"] and signing_key is None else ""
                lines.append(f"vehicle {sysid}: heard, but does not answer{advice}")
            for line in lines:
                output.out.print(line, style="red", markup=False, soft_wrap=True)
        if deaf or any(isinstance(one, Exception) for one in reports.values()):
            raise SystemExit(FELL_SHORT)
