"""What a campaign came to, setting by setting: quantiles over the seeds, and the worst."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gcs.campaign.axes import cell_of
from gcs.campaign.campaign import Campaign
from gcs.campaign.case import Case
from gcs.campaign.table import Row, Table


@dataclass(frozen=True)
class Setting:
    """All flights of one combination of values; None where no flight has the figure.

    Attributes:
        values: of the axes, as text.
        flights: how many there are.
        incomplete: in how many not every vehicle arrived.
        fell_short: in how many anything fell short.
        rms_error_m: median, 95 % and largest of the formation error.
        arrival_spread_s: the largest.
        min_separation_m, min_clearance_m: the least.
    """

    values: dict[str, str]
    flights: int
    incomplete: int
    fell_short: int
    rms_error_m: tuple[float, float, float] | None
    arrival_spread_s: float | None
    min_separation_m: float | None
    min_clearance_m: float | None


def summarise(campaign: Campaign, table: Table) -> list[Setting]:
    """Every combination of which there are rows."""
    found = []
    for values in campaign.settings():
        rows = [row for seed in campaign.seeds if (row := table.row_of(Case(values, seed)))]
        if rows:
            texts = {key: cell_of(value) for key, value in values}
            found.append(_setting(texts, rows, len(campaign.plan.uavs)))
    return found


def numbers(rows: Sequence[Row], column: str) -> npt.NDArray[np.float64]:
    """A column's numbers, those that there are."""
    return np.array([float(row[column]) for row in rows if row[column]])


def _setting(values: dict[str, str], rows: Sequence[Row], vehicles: int) -> Setting:
    spreads, separations = numbers(rows, "arrival_spread_s"), numbers(rows, "min_separation_m")
    clearances = numbers(rows, "min_clearance_m")
    return Setting(
        values=values,
        flights=len(rows),
        incomplete=sum(int(row["arrived"]) < vehicles for row in rows),
        fell_short=sum(int(row["shortfalls"]) > 0 for row in rows),
        rms_error_m=_quantiles(numbers(rows, "rms_error_m")),
        arrival_spread_s=float(spreads.max()) if len(spreads) else None,
        min_separation_m=float(separations.min()) if len(separations) else None,
        min_clearance_m=float(clearances.min()) if len(clearances) else None,
    )


def _quantiles(values: npt.NDArray[np.float64]) -> tuple[float, float, float] | None:
    """Median, 95 % and largest."""
    if not len(values):
        return None
    median, most, largest = np.quantile(values, (0.5, 0.95, 1.0)).tolist()
    return median, most, largest
