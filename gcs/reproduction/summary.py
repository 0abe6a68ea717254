"""What was reproduced, as JSON values: the table, the comparison of methods, and the paper's claims, measured."""

import math
from dataclasses import asdict
from typing import Any

import numpy as np
import numpy.typing as npt

from gcs.metrics.shape import shape
from gcs.metrics.tracks import tracks
from gcs.reproduction.distances import distances
from gcs.reproduction.reproduced import Reproduced
from planner.reproduction import Outcome, Study

EAST = (1.0, 0.0)
"""All origins of the paper lie on the y axis, all targets east of it."""


def summary(reproduced: Reproduced) -> dict[str, Any]:
    """All that was measured on one scenario; what is not finite is null."""
    scenario, flown = reproduced.scenario, reproduced.flown
    planned = tracks(reproduced.hybrid.references(scenario), {})
    values: dict[str, Any] = {
        "scenario": scenario.name,
        "seeds": list(reproduced.study.seeds),
        "table": [asdict(row) for row in distances(reproduced)],
        "radar_cost_km": {
            plan.method: math.fsum(uav.terms.radar for uav in plan.uavs)
            for plan in (reproduced.hybrid, reproduced.skein)
        },
        "shape_planned": asdict(shape(planned.planned_m, planned.t_s, EAST)),
        "methods": [_method(outcome, reproduced.study) for outcome in reproduced.study.outcomes],
    }
    if flown is not None:
        values["flight"] = {
            "completed": sum(vehicle.completed for vehicle in flown.metrics.vehicles),
            "min_separation_m": flown.metrics.formation.min_separation_m,
            "min_clearance_m": flown.metrics.formation.min_clearance_m,
            "min_wall_m": flown.metrics.formation.min_wall_m,
            "radar_exposure_s": flown.metrics.formation.radar_exposure_s,
            "shape": asdict(shape(flown.series.tracks.flown_m, flown.series.tracks.t_s, EAST)),
        }
    return values


def _method(outcome: Outcome, study: Study) -> dict[str, Any]:
    """One entrant: totals over all UAVs, how each UAV fared, and how often the hybrid of that seed was better."""
    hybrid = study.outcomes[0].totals_km
    entrant = outcome.entrant
    each = entrant.evaluations / entrant.iterations if entrant.iterations else None
    settled = outcome.settled()
    return {
        "method": entrant.method,
        "iterations": entrant.iterations,
        "evaluations": entrant.evaluations,
        "total_km": _quartiles(outcome.totals_km),
        "searches_without_path": int(np.sum(~np.isfinite(outcome.costs_km))),
        "seeds_hybrid_is_better": int(np.sum(hybrid < outcome.totals_km)),
        "uavs": [
            {
                "name": vehicle.name,
                "f_km": _quartiles(outcome.costs_km[:, column]),
                "within_1_percent_after": _median(settled[:, column] / each) if each else None,
            }
            for column, vehicle in enumerate(study.scenario.vehicles)
        ],
    }


def _quartiles(values: npt.NDArray[np.float64]) -> list[float | None]:
    """First, second and third, each a value that occurred."""
    return [_finite(float(place)) for place in np.quantile(values, (0.25, 0.5, 0.75), method="inverted_cdf")]


def _median(values: npt.NDArray[np.float64]) -> float | None:
    known = values[np.isfinite(values)]
    return float(np.median(known)) if len(known) else None


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
