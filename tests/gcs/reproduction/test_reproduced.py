from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from gcs.figures.fitness import draw_fitness
from gcs.figures.methods import draw_methods
from gcs.figures.paper import draw_paper
from gcs.flight_record import FlightRecord
from gcs.metrics import measure
from gcs.reproduction import Flown, Reproduced, distances, summary
from missions.reference import Reference
from missions.scenario import Scenario, load_scenario
from planner.formation_plan import FormationPlan
from planner.reproduction import Entrant, Outcome, Study, entrants
from sitl.formation.graph import edges

Make = Callable[..., Reproduced]


@pytest.fixture
def make(
    straight_plan: Callable[[Scenario], FormationPlan],
    fly_exactly: Callable[[dict[int, Reference]], dict[int, np.ndarray]],
    make_record: Callable[..., FlightRecord],
    few: Callable[[Scenario, int], Scenario],
) -> Make:
    """A paper scenario as it would be with straight plans, flown as planned, and made up searches."""

    def build(name: str, *, flown: bool = True, found: bool = True) -> Reproduced:
        scenario = few(load_scenario(name), 3)
        plan = straight_plan(scenario)
        flight = None
        if flown:
            truths = fly_exactly(plan.references(scenario))
            graph = edges("ring", list(truths))
            flight = Flown(truths, *measure(scenario, plan, truths, graph, make_record(plan)))
        outcomes = tuple(_outcome(entrant, found) for entrant in entrants(scenario))
        return Reproduced(scenario, plan, replace(plan, method="skein"), flight, Study(scenario, (1, 2), outcomes))

    return build


def _outcome(entrant: Entrant, found: bool) -> Outcome:
    """Searches that fall from 50 to 30 km; or find nothing."""
    n = np.linspace(1, entrant.evaluations, 60).astype(int)
    costs = 30.0 + 20.0 * np.exp(-n / 5000.0) + (0.0 if found else 1e9)
    history = tuple(zip(n.tolist(), costs.tolist(), strict=True))
    last = costs[-1] if found else np.inf
    return Outcome(entrant, np.full((2, 3), last), ((history,) * 3,) * 2)


def test_no_distance_is_below_the_straight_line(make: Make) -> None:
    for name in ("mountains", "radars"):
        for row in distances(make(name)):
            assert row.flown_km is not None
            for km in (row.planned_km, row.flown_km, row.skein_planned_km):
                assert km >= row.straight_km - 1e-3  # rounding of degrees on the wire
            assert row.straight_km == pytest.approx(np.linalg.norm(np.subtract(row.target_km, row.origin_km)))


def test_the_papers_lower_bounds(make: Make) -> None:
    leader, follower, _ = distances(make("mountains", flown=False))
    assert (round(leader.straight_km, 2), round(follower.straight_km, 2)) == (32.47, 27.04)
    assert round(distances(make("radars", flown=False))[0].straight_km, 2) == 36.20


@pytest.mark.parametrize(
    ("name", "numbers"), [("mountains", ("04", "05", "06", "07", "08")), ("radars", ("09", "10", "11", "12"))]
)
def test_each_of_the_papers_figures_is_drawn_and_shows_something(
    name: str, numbers: tuple[str, ...], make: Make, tmp_path: Path
) -> None:
    files = draw_paper(make(name), tmp_path)
    assert [file.name for file in files] == [*(f"figure-{number}.png" for number in numbers), f"methods-{name}.png"]
    for file in files:
        pixels = imread(file)[..., :3]
        assert pixels.std() > 0.03
        assert pixels[:, :2].std() < 0.01, "something is cut at the left"
        assert pixels[:, -2:].std() < 0.01, "something is cut at the right"
        assert pixels[-2:].std() < 0.01, "something is cut below"


def test_searches_that_found_nothing_can_be_told_and_drawn(make: Make, tmp_path: Path) -> None:
    nothing = make("radars", flown=False, found=False)
    draw_fitness(nothing.scenario, nothing.study.outcomes[0], 150, 0, "none", tmp_path / "fitness.png")
    draw_methods(nothing.study, "none", tmp_path / "methods.png")
    for name in ("fitness", "methods"):
        assert imread(tmp_path / f"{name}.png")[..., :3].std() > 0.03
    hybrid = summary(nothing)["methods"][0]
    assert hybrid["total_km"] == [None, None, None]
    assert hybrid["searches_without_path"] == 6
    assert hybrid["uavs"][0]["within_1_percent_after"] is None


def test_the_summary_says_who_won_and_what_the_flight_came_to(make: Make) -> None:
    values = summary(make("mountains"))
    assert [method["seeds_hybrid_is_better"] for method in values["methods"]] == [0, 0, 2, 2, 0, 0, 0]
    assert values["flight"]["completed"] == 3
    assert values["flight"]["shape"]["lead_from_s"] is not None
