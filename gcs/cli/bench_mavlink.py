"""`skein bench --mavlink`: the station and the endpoints, measured against other stations in the same run."""

import asyncio
from dataclasses import asdict

from rich.table import Table


def measure_mavlink(quick: bool, json: bool) -> None:
    """Measure and print: uploads against MAVSDK and MAVProxy, a station's load, what nine endpoints cost."""
    from gcs.bench.footprint import measure_footprint
    from gcs.bench.foreign_stations import compare_stations
    from gcs.bench.station_load import Load, listen
    from gcs.cli import output
    from gcs.cli.progress import working
    from missions.scenario import load_scenario

    scenario = load_scenario("vee")
    load = Load(seconds=2.0) if quick else Load()
    with working("Measuring endpoints, stations, a station's load", count=3) as bar:
        footprint = measure_footprint(scenario)
        bar.advance()
        stations = compare_stations(scenario)
        bar.advance()
        listened = asyncio.run(listen(load))
        bar.advance()
    if json:
        output.print_json(
            {"footprint": asdict(footprint), "stations": asdict(stations), "load": asdict(load) | asdict(listened)}
        )
        return
    table = Table("what", "figure", title="MAVLink at both ends")
    work = f"{stations.n_vehicles} vehicles, {stations.n_items} items each, uploaded and read back"
    table.add_row(f"{work}: Skein", f"{stations.skein_s:.3f} s")
    for name, seconds in (("MAVSDK", stations.mavsdk_s), ("MAVProxy", stations.mavproxy_s)):
        table.add_row(f"the same: {name}", f"{seconds:.3f} s, {seconds / stations.skein_s:.1f} times as long")
    table.add_row(f"{footprint.vehicles} endpoints ready", f"{footprint.ready_s:.2f} s")
    if footprint.pss_mib is not None:
        table.add_row("their memory (PSS), that of their nest included", f"{footprint.pss_mib:.0f} MiB")
    table.add_row(f"their {footprint.parameters} parameters fetched", f"{footprint.parameters_s:.3f} s")
    table.add_row(
        f"{load.vehicles} vehicles at {load.rate_hz:g} messages a second into one station",
        f"{100.0 * listened.core:.0f} % of a core, {listened.lost} of {listened.sent} lost",
    )
    output.print_wide(table)
