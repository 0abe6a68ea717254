"""Figures of merit, computed from truth, plan and scenario."""

from gcs.metrics.metrics import FormationMetrics, Metrics, VehicleMetrics, measure
from gcs.metrics.series import Series
from gcs.metrics.verdict import shortfalls

__all__ = ["FormationMetrics", "Metrics", "Series", "VehicleMetrics", "measure", "shortfalls"]
