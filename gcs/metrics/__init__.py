"""Figures of merit, computed from truth, plan and scenario."""

from gcs.metrics.metrics import FormationMetrics, Metrics, VehicleMetrics, measure
from gcs.metrics.planned import Planned, what_was_planned
from gcs.metrics.series import Series
from gcs.metrics.verdict import shortfalls

__all__ = [
    "FormationMetrics",
    "Metrics",
    "Planned",
    "Series",
    "VehicleMetrics",
    "measure",
    "shortfalls",
    "what_was_planned",
]
