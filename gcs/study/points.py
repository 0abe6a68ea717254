"""Flights that differ in their seeds alone, as one point of a curve."""

from collections.abc import Sequence
from dataclasses import dataclass

from gcs.study.fly import Results
from gcs.study.interval import Interval, interval
from gcs.study.trial import Outcome

MEASURES = ("rms_error_m", "relative_speed_m_s", "saturated", "effort_n_s")
"""Of an `Outcome`, those of which means are taken."""


@dataclass(frozen=True)
class Point:
    """Mean and 95 % confidence interval over the seeds.

    Attributes:
        curve, level: of the trials.
        flights: how many.
        measures: by `MEASURES`.
        separation_m: the least.
        incomplete: in how many flights not every survivor arrived.
    """

    curve: tuple[str, ...]
    level: float
    flights: int
    measures: dict[str, Interval]
    separation_m: float | None
    incomplete: int

    def row(self, names: Sequence[str], level: str) -> dict[str, str | float]:
        """As a row of a table whose curves have these names, and whose level this one."""
        means = {}
        for measure, found in self.measures.items():
            means[measure], means[f"{measure}_ci95"] = found.mean, found.half_width
        return {
            **dict(zip(names, self.curve, strict=True)),
            level: self.level,
            "flights": self.flights,
            **means,
            "least_separation_m": float("nan") if self.separation_m is None else self.separation_m,
            "incomplete": self.incomplete,
        }


def points_of(results: Results) -> list[Point]:
    """A point for each curve and level, in the order of the results."""
    groups: dict[tuple[tuple[str, ...], float], list[Outcome]] = {}
    for trial, outcome in results:
        groups.setdefault((trial.curve, trial.level), []).append(outcome)
    return [_point(curve, level, outcomes) for (curve, level), outcomes in groups.items()]


def _point(curve: tuple[str, ...], level: float, outcomes: list[Outcome]) -> Point:
    separations = [outcome.separation_m for outcome in outcomes if outcome.separation_m is not None]
    return Point(
        curve=curve,
        level=level,
        flights=len(outcomes),
        measures={
            measure: interval([getattr(o, measure) for o in outcomes if getattr(o, measure) is not None])
            for measure in MEASURES
        },
        separation_m=min(separations, default=None),
        incomplete=sum(outcome.arrived < outcome.survivors for outcome in outcomes),
    )


def on_curve(points: Sequence[Point], *curve: str) -> list[Point]:
    """The points of a curve, in order of level."""
    return sorted((point for point in points if point.curve == curve), key=lambda point: point.level)
