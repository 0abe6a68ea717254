"""What a console knows of the place: its surroundings, what is planned there, and the colours of the vehicles."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from gcs.console.chart import Chart, chart_around, chart_of
from gcs.delay_margin import delay_margin_s
from gcs.figures.paths import Ground, ground_below, planned_paths
from gcs.figures.style import VEHICLES, vehicle_colours
from missions.environment import Environment
from missions.frame import LocalFrame
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan
from sitl.stands import stands

FloatArray = npt.NDArray[np.float64]

LARGEST, SMALLEST = 0.4, 0.12
"""Of a drawn aircraft, in units of the scene."""


@dataclass(frozen=True)
class Place:
    """Where vehicles fly.

    Attributes:
        name: for people.
        frame: of all positions.
        chart: what is shown of it.
        ground, environment: None where nothing is known of them.
        paths: planned, (n, 3), by sysid.
        margin_s, stale_s: of the formation: ages of corrections beyond which it rings, and beyond which they count
            no more.
        duration_s: of the plan; 0 without.
        colours: of the vehicles that are known, by sysid.
    """

    name: str
    frame: LocalFrame
    chart: Chart
    ground: Ground | None = None
    environment: Environment | None = None
    paths: Mapping[int, FloatArray] = field(default_factory=dict)
    margin_s: float = 1.0
    stale_s: float = 3.0
    duration_s: float = 0.0
    colours: Mapping[int, Any] = field(default_factory=dict)

    def colour_of(self, sysid: int) -> Any:
        """A vehicle's colour, as matplotlib has it; the same everywhere."""
        return self.colours.get(sysid, VEHICLES[(sysid - 1) % len(VEHICLES)])

    @property
    def aircraft_size(self) -> float:
        """To be seen, in units of the scene: a little of the picture, and not much more than the room between two."""
        starts = np.array([path[0] for path in self.paths.values()])
        apart = np.linalg.norm(starts[:, None] - starts[None], axis=-1) if len(starts) > 1 else np.zeros((0, 0))
        nearest_m = float(apart[apart > 0.0].min()) if (apart > 0.0).any() else np.inf
        return float(np.clip(2.0 * nearest_m * self.chart.units_per_m, SMALLEST, LARGEST))


def place_of(scenario: Scenario, plan: FormationPlan | None) -> Place:
    """The place of a scenario, with what is planned there."""
    drawn: dict[int, FloatArray] = {}
    paths = {stand.sysid: np.array([stand.home_m]) for stand in stands(scenario)}
    duration_s = 0.0
    if plan is not None:
        references = plan.references(scenario)
        drawn = paths = planned_paths(references)
        duration_s = max(reference.duration_s for reference in references.values())
    environment, channel = scenario.environment, scenario.channel
    ground = ground_below(paths, environment)
    tops = [float(points[:, 2].max()) for points in paths.values()]
    tops += [obstacle.top_m for obstacle in environment.obstacles]
    stale_s = scenario.formation.delay_s + channel.jitter_s + scenario.formation.stale_s
    return Place(
        name=scenario.name,
        frame=scenario.frame,
        chart=chart_of(ground, max(tops)),
        ground=ground,
        environment=environment,
        paths=drawn,
        margin_s=min(delay_margin_s(scenario), stale_s),
        stale_s=stale_s,
        duration_s=duration_s,
        colours=vehicle_colours(scenario),
    )


def unknown_place(frame: LocalFrame, points_m: npt.ArrayLike) -> Place:
    """The place of vehicles that are at these points (n, 3) of a frame, of which nothing else is known."""
    return Place("vehicles", frame, chart_around(points_m))
