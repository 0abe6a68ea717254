"""One flight of a study: what it changes of the scenario, and what comes of it."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from gcs.metrics import Planned
from gcs.metrics.arrival import arrival
from gcs.metrics.formation_error import formation_error
from gcs.metrics.reassigned import with_moves
from gcs.metrics.separation import least_separation_m
from gcs.metrics.tracks import flown_tracks
from gcs.study.engine import Engine, engine_use
from gcs.study.relative_speed import relative_speed_rms_m_s
from gcs.truth import H, V, X
from missions.scenario import Scenario
from missions.scenario.network import ChannelModel, FailureModel, FormationModel
from planner.formation_plan import FormationPlan
from planner.reassign import reassigner_of
from sitl.config import Arm, VehicleConfig
from sitl.formation.graph import edges
from sitl.places import what_losses_lead_to
from sitl.rehearsal import Flown, rehearse
from sitl.swarm import SwarmOptions, vehicle_configs

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Trial:
    """What is flown.

    Attributes:
        curve, level: the point of a study that it belongs to: of which curve, and where on it.
        seed: of gusts and channels.
        formation, channel, failures, gusts: in place of the scenario's.
        arm: how much of the law is on.
    """

    curve: tuple[str, ...]
    level: float
    seed: int
    formation: FormationModel
    channel: ChannelModel
    failures: tuple[FailureModel, ...]
    gusts: str
    arm: Arm = "full"


def trial_of(scenario: Scenario, curve: tuple[str, ...], level: float, seed: int, arm: Arm = "full") -> Trial:
    """The scenario as it is."""
    return Trial(
        curve,
        level,
        seed,
        scenario.formation,
        scenario.channel,
        scenario.failures,
        scenario.wind.gusts,
        arm,
    )


@dataclass(frozen=True)
class Outcome:
    """What came of a trial; None where nothing is left to measure.

    Attributes:
        rms_error_m: formation error, RMS, from 0 to the planned arrival.
        relative_speed_m_s: RMS over the edges of the difference of e'.
        saturated: share of ticks on the way at which all thrust, or none, was asked for.
        effort_n_s: how much the thrust changes in a second, mean.
        separation_m: least distance of any two on their way.
        nearest_m: least distance of any two, those that circle at their targets included.
        survivors: vehicles that nothing is to kill.
        arrived: how many of those did.
        last_s: when the last of them did.
    """

    rms_error_m: float | None
    relative_speed_m_s: float | None
    saturated: float
    effort_n_s: float
    separation_m: float | None
    nearest_m: float | None
    survivors: int
    arrived: int
    last_s: float | None


def fly_trial(scenario: Scenario, plan: FormationPlan, planned: Planned, trial: Trial) -> Outcome:
    """Rehearse a trial and measure it."""
    changed = scenario.model_copy(
        update={
            "formation": trial.formation,
            "channel": trial.channel,
            "failures": trial.failures,
            "wind": scenario.wind.model_copy(update={"gusts": trial.gusts}),
        }
    )
    reassign = reassigner_of(changed, plan)
    options = SwarmOptions(trial.seed, trial.formation.delay_s, trial.arm, reassign=reassign)
    vehicles = vehicle_configs(changed, options)
    flown_as = with_moves(planned, what_losses_lead_to(vehicles[0]))
    return measured(rehearse(vehicles, plan.missions), changed, vehicles, flown_as)


def measured(flown: Flown, scenario: Scenario, vehicles: list[VehicleConfig], planned: Planned) -> Outcome:
    """What came of a flight."""
    sysids = [vehicle.sysid for vehicle in vehicles]
    graph = edges(scenario.formation.graph, sysids)
    deaths = vehicles[0].network.deaths
    ends = {sysid: arrival(flown.truth[sysid], planned.references[sysid]) for sysid in sysids}
    ways = {sysid: end.tick or len(flown.truth[sysid]) for sysid, end in ends.items()}
    engines = [
        engine_use(flown.thrust_n[i][: ways[i]], flown.truth[i][: ways[i], V], vehicles[0].airframe) for i in sysids
    ]
    there = [ends[sysid].time_s for sysid in sysids if sysid not in deaths]
    arrived = [time_s for time_s in there if time_s is not None]
    everywhere = _positions(flown, sysids)
    on_their_way = everywhere.copy()
    for row, sysid in enumerate(sysids):
        on_their_way[row, ways[sysid] :] = np.nan
    return Outcome(
        rms_error_m=formation_error(flown_tracks(planned.tracks, flown.truth), graph).overall_rms_m,
        relative_speed_m_s=relative_speed_rms_m_s(flown.along_rate_m_s, graph),
        saturated=_mean(engines, "saturated"),
        effort_n_s=_mean(engines, "effort_n_s"),
        separation_m=_least(on_their_way),
        nearest_m=_least(everywhere),
        survivors=len(there),
        arrived=len(arrived),
        last_s=max(arrived, default=None),
    )


def _positions(flown: Flown, sysids: list[int]) -> FloatArray:
    """(n, ticks, 3); NaN from a vehicle's end on."""
    positions = np.full((len(sysids), max(map(len, flown.truth.values())), 3), np.nan)
    for row, sysid in enumerate(sysids):
        truth = flown.truth[sysid]
        positions[row, : len(truth)] = truth[:, X : H + 1]
    return positions


def _least(positions: FloatArray) -> float | None:
    least = least_separation_m(positions)
    return float(np.nanmin(least)) if np.isfinite(least).any() else None


def _mean(engines: list[Engine], key: str) -> float:
    return float(np.mean([getattr(engine, key) for engine in engines]))
