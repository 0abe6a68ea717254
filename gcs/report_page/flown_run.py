"""A run that has been flown, as it is kept in its folder."""

from dataclasses import dataclass
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from gcs.metrics import Check, Metrics, Series, checks, series_of
from gcs.run_folder import RunFolder
from gcs.truth import Truths, read_shifts, read_truths
from missions.errors import InputError
from missions.reassignment import Loss, Reassigned
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from planner.reassign import reassigner_of
from sitl.formation.graph import edges
from sitl.places import what_losses_lead_to
from sitl.swarm import SwarmOptions, vehicle_configs


@dataclass(frozen=True)
class FlownRun:
    """What a run's folder tells.

    Attributes:
        name: of the folder.
        text: of the scenario's file.
        truths, series: what was flown, by sysid, and over time.
        checks: what it is held to.
    """

    name: str
    text: str
    scenario: Scenario
    plan: FormationPlan
    truths: Truths
    metrics: Metrics
    series: Series
    checks: list[Check]

    @property
    def shortfalls(self) -> list[str]:
        """A line for each thing that fell short."""
        return [check.shortfall for check in self.checks if check.room < 0.0]


def read_flown_run(path: Path) -> FlownRun:
    """Read a run's folder.

    Raises:
        InputError: it is no run, it has not been flown, or a file in it cannot be used.
    """
    run = RunFolder(path)
    scenario, plan = run.read()
    metrics = _metrics(path / "metrics.json")
    sysids = [uav.sysid for uav in plan.uavs]
    truths = read_truths(run.truth, [sysid for sysid in sysids if (run.truth / f"{sysid}.f64").exists()])
    if not truths:
        raise InputError(f"{run.truth}: holds no vehicle's truth; fly the run again with `skein fly`")
    graph, shifts = edges(scenario.formation.graph, sysids), read_shifts(run.truth, truths)
    series = series_of(scenario, plan, truths, graph, shifts, _reassigned(scenario, plan, metrics))
    return FlownRun(
        name=path.resolve().name,
        text=run.scenario.read_text(encoding="utf-8"),
        scenario=scenario,
        plan=plan,
        truths=truths,
        metrics=metrics,
        series=series,
        checks=checks(metrics, scenario),
    )


def _reassigned(scenario: Scenario, plan: FormationPlan, metrics: Metrics) -> Reassigned:
    """Who took whose place in the flight."""
    options = SwarmOptions(metrics.seed, metrics.delay_s, metrics.arm, reassign=reassigner_of(scenario, plan))
    first, *_ = vehicle_configs(scenario, options)
    return what_losses_lead_to(first, [Loss(loss.t_s, frozenset(loss.gone)) for loss in metrics.losses])


def _metrics(file: Path) -> Metrics:
    try:
        return TypeAdapter(Metrics).validate_json(file.read_bytes())
    except OSError as error:
        raise InputError(f"{file}: {error.strerror}; has the run been flown? `skein fly` does that") from None
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        key = ".".join(map(str, first["loc"])) or "the file"
        raise InputError(f"{file}: {key}: {first['msg']}; fly the run again with `skein fly`") from None
