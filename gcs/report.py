"""What a flight came to: metrics.json and figures, from truth, plan and scenario."""

import contextlib
from dataclasses import dataclass, replace
from typing import Any

from gcs.figures import draw_all
from gcs.flight_record import LOST, FlightRecord
from gcs.metrics import Series, measure, shortfalls
from gcs.run_folder import RunFolder
from gcs.truth import Truths, read_shifts, read_truth, read_truths
from missions.errors import InputError
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.formation.graph import edges
from sitl.ticks import TICK_S


@dataclass(frozen=True)
class Report:
    """What a flight came to.

    Attributes:
        metrics: what metrics.json holds.
        shortfalls: what fell short, a line each.
        series: figures of merit over time.
    """

    metrics: dict[str, Any]
    shortfalls: list[str]
    series: Series


def report_on(scenario: Scenario, plan: FormationPlan, truths: Truths, record: FlightRecord) -> Report:
    """Measure a flight."""
    graph = edges(scenario.formation.graph, [uav.sysid for uav in plan.uavs])
    metrics, series = measure(scenario, plan, truths, graph, record)
    return Report(metrics.as_json(), shortfalls(metrics, scenario), series)


def keep_report(run: RunFolder, scenario: Scenario, plan: FormationPlan, truths: Truths, report: Report) -> None:
    """Write metrics.json and the figures. Raises InputError when the run's folder cannot be written to."""
    run.write_json("metrics.json", report.metrics)
    draw_all(scenario, plan, truths, report.series, run.figures)


def write_report(run: RunFolder, scenario: Scenario, plan: FormationPlan, record: FlightRecord) -> Report:
    """Measure a flight that endpoints have recorded, write metrics.json and the figures.

    Raises:
        InputError: a truth file is missing, or the run's folder cannot be written to.
    """
    truths = read_truths(run.truth, [uav.sysid for uav in plan.uavs if uav.sysid not in record.lost])
    for sysid in record.lost:
        with contextlib.suppress(InputError):  # lost before it had recorded anything
            truths[sysid] = read_truth(run.truth / f"{sysid}.f64")
    record = replace(_timed_by_truth(record, truths), shifts=read_shifts(run.truth, truths))
    report = report_on(scenario, plan, truths, record)
    keep_report(run, scenario, plan, truths, report)
    return report


def _timed_by_truth(record: FlightRecord, truths: Truths) -> FlightRecord:
    """The record with the times of losses that the truth tells; the station only noticed later."""
    lost = {sysid: len(truths[sysid]) * TICK_S if sysid in truths else t_s for sysid, t_s in record.lost.items()}
    events = [
        replace(event, t_s=lost[event.sysid])
        if event.sysid is not None and event.sysid in lost and event.what.startswith(LOST)
        else event
        for event in record.events
    ]
    return replace(record, lost=lost, events=tuple(events))
