"""Figures of merit of one flight: what metrics.json holds."""

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from gcs.flight_record import Event, FlightRecord, Timing
from gcs.metrics.arrival import Arrival, arrival
from gcs.metrics.flight_limits import FlightLimits, flight_limits
from gcs.metrics.formation_error import Edge, formation_error
from gcs.metrics.graph_used import GraphUsed, graph_used
from gcs.metrics.planned import Planned, what_was_planned
from gcs.metrics.reassigned import moved, with_moves
from gcs.metrics.scheduled import scheduled
from gcs.metrics.separation import least_separation_m
from gcs.metrics.series import Series
from gcs.metrics.surroundings import Surroundings, airborne_row, surroundings
from gcs.metrics.swarm_time import SwarmTime, swarm_time
from gcs.metrics.tracks import flown_tracks
from gcs.metrics.yielded import yielded
from gcs.truth import H, Truths, trajectory_sha256
from missions.reassignment import Reassigned
from missions.scenario import Scenario
from planner.formation_plan import FitnessTerms, FormationPlan, UavPlan
from sitl.config import Arm
from sitl.formation.link_report import LinkReport, mean_delay_s
from sitl.scenario_network import network_of


@dataclass(frozen=True)
class VehicleMetrics:
    """One vehicle. `fitness` and its terms are kilometres; `lost_s` is when it was lost, if it was; `place` is whose
    plan it flew in the end, and `planned_arrival_s` is that one's."""

    sysid: int
    name: str
    fitness: float
    fitness_terms: FitnessTerms
    straight_line_km: float
    planned_length_km: float
    flown_length_km: float | None
    planned_arrival_s: float
    arrival_s: float | None
    completed: bool
    lost_s: float | None
    place: int
    items_uploaded: int | None
    items_verified: int | None


@dataclass(frozen=True)
class AgreedLoss:
    """Vehicles that count as lost from a time on, as those who are left have agreed; no schedule has foreseen it."""

    t_s: float
    gone: tuple[int, ...]


@dataclass(frozen=True)
class FormationMetrics:
    """All vehicles together; None is unknown, or not defined for so few vehicles.

    `measured_delay_s` is, in real time, the mean over all samples of the injected delay and the real one; samples were
    late that took a tick or more of real delay, lost that never came, refused that were not let in.
    `slowed_s` and `hurried_s` are what the swarm's clock did to the schedule, and errors are of it then.
    `clearance_margin_m` is what is left above limits.clearance_m, which grows from 0 over limits.climb_out_m, and
    `min_wall_m` the least distance from an obstacle.
    """

    delay_margin_s: float | None
    rms_error_m: float | None
    max_error_m: float | None
    arrival_spread_s: float | None
    min_separation_m: float | None
    min_clearance_m: float | None
    clearance_margin_m: float | None
    min_wall_m: float | None
    radar_exposure_s: float
    late_samples: int
    lost_samples: int
    refused_samples: int
    measured_delay_s: float | None
    slowed_s: float | None
    hurried_s: float | None


@dataclass(frozen=True)
class Metrics:
    """One flight of a scenario."""

    scenario: str
    seed: int
    delay_s: float
    arm: Arm
    real_time: bool
    behind_s: float
    trajectory_sha256: str | None
    vehicles: tuple[VehicleMetrics, ...]
    formation: FormationMetrics
    timing: Timing
    events: tuple[Event, ...]
    graph: tuple[GraphUsed, ...]
    losses: tuple[AgreedLoss, ...]
    links: tuple[LinkReport, ...]
    limits: tuple[FlightLimits, ...]

    def as_json(self) -> dict[str, Any]:
        """The metrics as JSON values; what is not finite is null."""
        values = _finite(asdict(self))
        assert isinstance(values, dict)
        return values


def measure(
    scenario: Scenario,
    plan: FormationPlan,
    truths: Truths,
    edges: Sequence[Edge],
    record: FlightRecord,
    planned: Planned | None = None,
) -> tuple[Metrics, Series]:
    """Compute the figures of merit of a flight, and what they are over time.

    Args:
        scenario, plan: what was flown.
        truths: what the endpoints recorded, by sysid (`gcs.truth.read_truths`).
        edges: of the nominal graph, pairs of sysids.
        record: what else became of the flight.
        planned: of the plan, where it is at hand.
    """
    planned = with_moves(planned or what_was_planned(scenario, plan), record.reassigned)
    references = planned.references
    arrivals = {sysid: arrival(truth, references[sysid]) for sysid, truth in truths.items()}
    time = swarm_time(record.shifts) if record.shifts else None
    series = _series(planned, truths, edges, arrivals, time)
    around = [surroundings(positions, scenario) for positions in series.tracks.flown_m]
    late = [end.time_s - references[i].duration_s for i, end in arrivals.items() if end.time_s is not None]
    arrived = [Event(end.time_s, i, "arrived") for i, end in arrivals.items() if end.time_s is not None]
    ends = [end.tick for end in arrivals.values() if end.tick is not None]
    # A vehicle that was lost or stopped leaves a truth that ends where chance had it, unless the scenario had it so.
    deaths = network_of(scenario, tuple(references), record.delay_s).deaths
    whole = (
        not record.real_time
        and record.lost.keys() <= deaths.keys()
        and all(len(truth) > max(ends, default=0) or len(truth) == deaths.get(sysid) for sysid, truth in truths.items())
    )
    metrics = Metrics(
        scenario=scenario.name,
        seed=record.seed,
        delay_s=record.delay_s,
        arm=record.arm,
        real_time=record.real_time,
        behind_s=record.behind_s,
        trajectory_sha256=trajectory_sha256(truths, max(ends)) if ends and whole else None,
        vehicles=tuple(
            _vehicle(uav, references[uav.sysid].duration_s, arrivals.get(uav.sysid), record) for uav in plan.uavs
        ),
        formation=_formation(series, around, late, record, time),
        timing=record.timing,
        events=_in_order(
            record.events, scheduled(scenario), yielded(record.yieldings), moved(record.reassigned), arrived
        ),
        graph=graph_used(record.edges),
        losses=tuple(AgreedLoss(loss.t_s, tuple(sorted(loss.gone))) for loss in record.losses),
        links=record.links,
        limits=tuple(
            flight_limits(sysid, truth[airborne_row(truth[:, : H + 1], scenario) or 0 : _rows(arrivals[sysid])])
            for sysid, truth in sorted(truths.items())
        ),
    )
    return metrics, series


def series_of(
    scenario: Scenario,
    plan: FormationPlan,
    truths: Truths,
    edges: Sequence[Edge],
    shifts: Truths,
    reassigned: Reassigned,
) -> Series:
    """What `measure` tells over time, by itself."""
    planned = with_moves(what_was_planned(scenario, plan), reassigned)
    arrivals = {sysid: arrival(truth, planned.references[sysid]) for sysid, truth in truths.items()}
    return _series(planned, truths, edges, arrivals, swarm_time(shifts) if shifts else None)


def _series(
    planned: Planned,
    truths: Truths,
    edges: Sequence[Edge],
    arrivals: Mapping[int, Arrival],
    time: SwarmTime | None,
) -> Series:
    common = flown_tracks(planned.tracks, truths, time)
    return Series(
        tracks=common,
        error=formation_error(common, edges),
        separation_m=least_separation_m(common.flown_m),
        references=planned.references,
        arrivals_s={
            sysid: time.shown_at(end.time_s) if time is not None and end.time_s is not None else end.time_s
            for sysid, end in arrivals.items()
        },
    )


def _vehicle(uav: UavPlan, planned_s: float, end: Arrival | None, record: FlightRecord) -> VehicleMetrics:
    return VehicleMetrics(
        sysid=uav.sysid,
        name=uav.name,
        fitness=uav.terms.fitness,
        fitness_terms=uav.terms,
        straight_line_km=uav.straight_line_m / 1000.0,
        planned_length_km=uav.length_m / 1000.0,
        flown_length_km=end.length_m / 1000.0 if end else None,
        planned_arrival_s=planned_s,
        arrival_s=end.time_s if end else None,
        completed=end is not None and end.time_s is not None,
        lost_s=record.lost.get(uav.sysid),
        place=record.reassigned.place_of(uav.sysid),
        items_uploaded=record.items_uploaded.get(uav.sysid),
        items_verified=record.items_verified.get(uav.sysid),
    )


def _formation(
    series: Series,
    around: Sequence[Surroundings],
    late_s: Sequence[float],
    record: FlightRecord,
    time: SwarmTime | None,
) -> FormationMetrics:
    known = series.separation_m[np.isfinite(series.separation_m)]
    return FormationMetrics(
        delay_margin_s=record.delay_margin_s,
        rms_error_m=series.error.overall_rms_m,
        max_error_m=series.error.overall_max_m,
        arrival_spread_s=max(late_s) - min(late_s) if late_s else None,
        min_separation_m=float(known.min()) if len(known) else None,
        min_clearance_m=_least(one.clearance_m for one in around),
        clearance_margin_m=_least(one.clearance_margin_m for one in around),
        min_wall_m=_least(one.wall_m for one in around),
        radar_exposure_s=math.fsum(one.radar_exposure_s for one in around),
        late_samples=sum(link.late for link in record.links),
        lost_samples=sum(link.lost for link in record.links),
        refused_samples=sum(sum(link.refused.values()) for link in record.links),
        measured_delay_s=mean_delay_s(record.links),
        slowed_s=float(time.slowed_s[-1]) if time else None,
        hurried_s=float(time.hurried_s[-1]) if time else None,
    )


def _in_order(*events: Iterable[Event]) -> tuple[Event, ...]:
    return tuple(sorted(itertools.chain(*events), key=lambda event: event.t_s))


def _rows(end: Arrival) -> int | None:
    """How many rows of a truth are the flight itself; None for all."""
    return None if end.tick is None else end.tick + 1


def _least(values: Iterable[float | None]) -> float | None:
    return min((value for value in values if value is not None), default=None)


def _finite(value: object) -> object:
    """JSON values without NaN and infinities, which JSON does not have."""
    if isinstance(value, dict):
        return {key: _finite(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
