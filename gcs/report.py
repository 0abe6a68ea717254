"""What a flight came to: metrics.json and figures, from truth, plan and scenario."""

import contextlib
from typing import Any

from gcs.figures import draw_all
from gcs.flight_record import FlightRecord
from gcs.metrics import measure, shortfalls
from gcs.run_folder import RunFolder
from gcs.truth import read_truth, read_truths
from missions.errors import InputError
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.formation.graph import edges


def write_report(
    run: RunFolder, scenario: Scenario, plan: FormationPlan, record: FlightRecord
) -> tuple[dict[str, Any], list[str]]:
    """Measure a flight, write metrics.json and the figures.

    Returns:
        The metrics as JSON values, and what fell short, a line each.

    Raises:
        InputError: a truth file is missing, or the run's folder cannot be written to.
    """
    sysids = [uav.sysid for uav in plan.uavs]
    truths = read_truths(run.truth, [sysid for sysid in sysids if sysid not in record.lost])
    for sysid in record.lost:
        with contextlib.suppress(InputError):  # lost before it had recorded anything
            truths[sysid] = read_truth(run.truth / f"{sysid}.f64")
    metrics, series = measure(scenario, plan, truths, edges(scenario.formation.graph, sysids), record)
    values = metrics.as_json()
    run.write_json("metrics.json", values)
    draw_all(scenario, plan, truths, series, run.figures)
    return values, shortfalls(metrics, scenario)
