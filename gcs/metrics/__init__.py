"""Figures of merit, computed from truth, plan and scenario."""

from gcs.metrics.metrics import FormationMetrics, Metrics, VehicleMetrics, measure, series_of
from gcs.metrics.planned import Planned, what_was_planned
from gcs.metrics.series import Series
from gcs.metrics.verdict import Check, checks, shortfalls

__all__ = [
    "Check",
    "FormationMetrics",
    "Metrics",
    "Planned",
    "Series",
    "VehicleMetrics",
    "checks",
    "measure",
    "series_of",
    "shortfalls",
    "what_was_planned",
]
