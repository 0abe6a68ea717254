"""The tables that commands print for people; they fit 80 columns. An order to vehicles must not wait for a planner."""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.markup import escape
from rich.table import Table

from sitl.services.links import LOOPBACK

if TYPE_CHECKING:
    from gcs.companion.connected_flight import Arrival
    from missions.scenario import Scenario
    from planner.formation_plan import FormationPlan
    from planner.standing import Standing
    from planner.verify import VerificationReport
    from sitl.swarm import Swarm


def plan_table(plan: "FormationPlan", scenario: "Scenario") -> Table:
    """What each UAV's path costs, how far it is from the best known (of that UAV alone), and how long it is."""
    from planner.standing import standings

    table = _table(
        f"Plan of {plan.scenario}, {plan.method}, seed {plan.seed}, in {plan.plan_s:.2f} s, verified",
        ["UAV", "f km", "f / line", "gap", "length", "terrain", "radar", "altitude"],
    )
    alone, together = standings(plan, scenario)
    for uav, standing in zip(plan.uavs, alone, strict=True):
        terms = uav.terms
        table.add_row(
            f"{uav.sysid} {uav.name}",
            f"{terms.fitness:.3f}",
            f"{terms.fitness * 1000.0 / uav.straight_line_m:.3f}",
            _gap(standing),
            *(f"{term:.2f}" for term in (terms.length, terms.terrain, terms.radar, terms.altitude)),
        )
    table.add_section()
    table.add_row("all", f"{together.fitness_km:.3f}", "", _gap(together))
    return table


def planned_table(report: "VerificationReport", plan: "FormationPlan", scenario: "Scenario") -> Table:
    """What each UAV is to fly: figures that an operator compares with what the aircraft can do."""
    table = _table(
        "To be flown",
        ["UAV", "km", "min", "highest\nm AMSL", "up/down\ndeg", "airspeed\nm/s", "power", "nearest\nother m"],
    )
    for uav, verified in zip(plan.uavs, report.uavs, strict=True):
        table.add_row(
            f"{uav.sysid} {uav.name}",
            f"{uav.length_m / 1000.0:.2f}",
            f"{verified.arrival_s / 60.0:.1f}",
            f"{verified.altitude_max_m + scenario.origin.alt_m:.0f}",
            f"{verified.climb_deg:.1f} / {verified.descent_deg:.1f}",
            f"{verified.airspeed_min_m_s:.1f}-{verified.airspeed_max_m_s:.1f}",
            f"{verified.power_share:.0%}",
            f"{verified.separation_m:.0f}" if math.isfinite(verified.separation_m) else "-",
        )
    return table


def _gap(standing: "Standing") -> str:
    """Per cent above the best known; below it, by how much, when that shows."""
    if standing.gap is None:
        return "-"
    return f"{round(100.0 * standing.gap, 3) + 0.0:.3f}%"


def results_table(title: str, sysids: list[int], done: dict[int, str], failed: dict[int, str]) -> Table:
    """What came of an order, a vehicle a row."""
    table = Table("vehicle", "", "result", title=title, title_justify="left")
    for sysid in sysids:
        if sysid in failed:
            reason = failed[sysid].removeprefix(f"vehicle {sysid}: ")
            table.add_row(str(sysid), "[red]failed[/red]", escape(reason))
        else:
            table.add_row(str(sysid), "[green]ok[/green]", escape(done[sysid]))
    return table


def status_table(reports: dict[int, Any]) -> Table:
    """What each vehicle says of itself; in 80 columns, for all but the longest addresses."""
    table = _table("Vehicles", ["id", "address", "mode", "state", "above\nhome m", "air\nm/s", "item"])
    for column in table.columns:
        column.no_wrap = column.header != "address"
    for sysid, report in reports.items():
        if isinstance(report, Exception):
            table.add_row(str(sysid), "-", "-", "[red]failed[/red]", "-", "-", "-")
            continue
        table.add_row(
            str(sysid),
            report["address"],
            report["mode"],
            _state(report),
            _shown(report["relative_altitude_m"], ".0f"),
            _shown(report["airspeed_m_s"], ".1f"),
            f"{report['mission_item']}/{report['mission_items']}" if report["mission_items"] else "-",
        )
    return table


def _state(report: dict[str, Any]) -> str:
    """Disarmed, or armed and where; a breached fence above all."""
    if report["fence_breached"]:
        return "[red]breach[/red]"
    if not report["armed"]:
        return "disarmed"
    where = report["landed_state"]
    return "[yellow]armed[/yellow]" if where in (None, "on ground") else str(where)


def flight_table(metrics: dict[str, Any]) -> Table:
    """What each vehicle did; and whose place it took, where places were reassigned."""
    moved = any(vehicle["place"] != vehicle["sysid"] for vehicle in metrics["vehicles"])
    headings = ["items", "arrival s", "late by\ns", "planned\nkm", "flown\nkm", "completed"]
    table = _table(
        f"Flight of {metrics['scenario']}, seed {metrics['seed']}, delay {metrics['delay_s']:g} s",
        ["vehicle", *["place"] * moved, *headings],
    )
    for vehicle in metrics["vehicles"]:
        arrival, planned = vehicle["arrival_s"], vehicle["planned_arrival_s"]
        table.add_row(
            f"{vehicle['sysid']} {vehicle['name']}",
            *[str(vehicle["place"])] * moved,
            "-" if vehicle["items_uploaded"] is None else f"{vehicle['items_verified']}/{vehicle['items_uploaded']}",
            _shown(arrival, ".1f"),
            "-" if arrival is None else f"{arrival - planned:+.2f}",
            _shown(vehicle["planned_length_km"], ".2f"),
            _shown(vehicle["flown_length_km"], ".2f"),
            _end(vehicle),
        )
    return table


def _end(vehicle: dict[str, Any]) -> str:
    if vehicle["completed"]:
        return "yes"
    return "[red]no[/red]" if vehicle["lost_s"] is None else f"[red]lost {vehicle['lost_s']:.0f}[/red]"


def arrival_table(arrivals: "Sequence[Arrival]", spread_s: float | None) -> Table:
    """How vehicles that were there arrived."""
    title = "Arrivals" if spread_s is None else f"Arrivals, spread over {spread_s:.2f} s against the plan"
    table = Table(title=title, title_justify="left")
    table.add_column("vehicle")
    for heading in ("armed s", "planned s", "arrived s", "late by s", "e RMS m", "e max m"):
        table.add_column(heading, justify="right")
    for one in arrivals:
        late = None if one.arrived_s is None else one.arrived_s - one.planned_s
        table.add_row(
            f"{one.sysid} {one.name}",
            f"+{one.started_s:.2f}",
            f"{one.planned_s:.1f}",
            "[red]no[/red]" if one.arrived_s is None else f"{one.arrived_s:.1f}",
            _shown(late),
            _shown(one.along_rms_m, ".1f"),
            _shown(one.along_max_m, ".1f"),
        )
    return table


def formation_table(metrics: dict[str, Any]) -> Table:
    """Figures of merit of the whole."""
    formation, timing = metrics["formation"], metrics["timing"]
    table = Table(show_header=False)
    table.add_column()
    table.add_column(justify="right")
    rows = [
        (
            "formation error, RMS / largest",
            f"{_shown(formation['rms_error_m'])} / {_shown(formation['max_error_m'])} m",
        ),
        ("arrival spread", f"{_shown(formation['arrival_spread_s'])} s"),
        ("least separation", f"{_shown(formation['min_separation_m'], '.0f')} m"),
        ("least clearance once 30 m up", f"{_shown(formation['min_clearance_m'], '.0f')} m"),
        ("least clearance above the limit", f"{_shown(formation['clearance_margin_m'], '.0f')} m"),
        ("radar exposure", f"{_shown(formation['radar_exposure_s'], '.0f')} s"),
        ("delay / margin", f"{metrics['delay_s']:g} / {_shown(formation['delay_margin_s'])} s"),
        (
            "planning / start-up / upload",
            " / ".join(_shown(timing[key], ".1f") for key in ("plan_s", "startup_s", "upload_s")) + " s",
        ),
        ("flight, wall time", f"{timing['flight_sim_s']:.0f} s in {timing['flight_wall_s']:.3g} s"),
        ("times real time", f"{timing['real_time_factor']:.0f}"),
        ("trajectory", (metrics["trajectory_sha256"] or "none")[:16]),
    ]
    if metrics["real_time"]:
        rows.insert(7, ("real and injected delay, measured", f"{_shown(formation['measured_delay_s'], '.3f')} s"))
        rows.insert(8, ("most behind the clock, wall time", f"{metrics['behind_s']:.3f} s"))
    if formation["slowed_s"] is not None:
        shifts = f"{_shown(formation['slowed_s'], '.1f')} / {_shown(formation['hurried_s'], '.1f')} s"
        rows.insert(2, ("swarm clock, slowed / hurried", shifts))
    counts = [formation[key] for key in ("late_samples", "lost_samples", "refused_samples")]
    if metrics["real_time"] or any(counts):
        rows.insert(-1, ("samples late / lost / refused", " / ".join(map(str, counts))))
    for row in rows:
        table.add_row(*row)
    return table


def link_table(metrics: dict[str, Any]) -> Table | None:
    """What came of each link, in real time; None in lockstep."""
    if not metrics["real_time"]:
        return None
    table = _table("Links", ["from - to", "heard", "late", "lost", "refused", "delay, mean s", "most s"])
    for link in metrics["links"]:
        table.add_row(
            f"{link['sender']} - {link['receiver']}",
            *(str(link[key]) for key in ("heard", "late", "lost")),
            str(sum(link["refused"].values())),
            _shown(link["delay_mean_s"], ".3f"),
            _shown(link["delay_max_s"], ".3f"),
        )
    return table


def endpoint_table(name: str, swarm: "Swarm") -> Table:
    """Where each endpoint can be reached."""
    table = _table(f"{name}: {len(swarm.endpoints)} vehicles", ["vehicle", "TCP server", "UDP socket", "process"])
    for endpoint in swarm.endpoints.values():
        if endpoint.ready is not None:
            table.add_row(
                f"{endpoint.sysid} {endpoint.name}",
                f"{LOOPBACK}:{endpoint.ready.tcp_port}",
                f"{LOOPBACK}:{endpoint.ready.udp_port}",
                str(endpoint.process.pid),
            )
    return table


def ways_to_connect(swarm: "Swarm", stations: Sequence[tuple[str, int]], state: Path) -> Iterator[str]:
    """How the usual stations reach a swarm, and where its vehicles keep what they know."""
    (host, port), *_ = stations
    tcp_port = next(endpoint.ready.tcp_port for endpoint in swarm.endpoints.values() if endpoint.ready)
    opens = "by itself" if port == 14550 else f"with a UDP link on port {port}"
    yield "Telemetry goes to UDP " + ", ".join(f"{host}:{port}" for host, port in stations)
    yield f"QGroundControl: connects {opens}, or with a TCP link to {LOOPBACK}:{tcp_port}"
    yield f"MAVProxy:       mavproxy.py --master udpin:{host}:{port}  (all), --master tcp:{LOOPBACK}:{tcp_port}  (one)"
    yield f"MAVSDK:         udpin://{host}:{port}  (all), tcpout://{LOOPBACK}:{tcp_port}  (one)"
    yield f"State:          {state}/<system id>"


def _table(title: str, headings: list[str]) -> Table:
    table = Table(title=title, title_justify="left")
    for i, heading in enumerate(headings):
        table.add_column(heading, justify="left" if i == 0 else "right")
    return table


def _shown(value: float | None, form: str = ".2f") -> str:
    return "-" if value is None else format(value, form)
