import math

import numpy as np
import pytest

from missions.scenario import Scenario, load_scenario
from planner.cost.kernel import INFEASIBLE_KM
from planner.reproduction import Entrant, Outcome, Study, study

PROGRESS: list[float] = []


@pytest.fixture(scope="module")
def small() -> Study:
    """Two UAVs of `mountains` with a tenth of the budget, two seeds."""
    scenario = load_scenario("mountains")
    cut = scenario.model_copy(
        update={
            "vehicles": scenario.vehicles[:2],
            "search": scenario.search.model_copy(update={"iterations": 20}),
        }
    )
    return study(cut, (3, 4), PROGRESS.append)


def straight_km(scenario: Scenario) -> list[float]:
    return [math.dist(scenario.origin_m(of), scenario.target_m(of)) / 1000.0 for of in scenario.vehicles]


def test_no_fitness_is_below_the_straight_line(small: Study) -> None:
    for outcome in small.outcomes:
        assert outcome.costs_km.shape == (2, 2)
        assert (outcome.costs_km > straight_km(small.scenario)).all()


def test_a_search_gets_better_and_ends_with_what_is_reported_within_its_budget(small: Study) -> None:
    for outcome in small.outcomes:
        after = outcome.best_after_km(np.linspace(0, outcome.entrant.evaluations, 50))
        assert np.isinf(after[:, :, 0]).all()
        known = np.where(np.isfinite(after), after, INFEASIBLE_KM)
        assert (np.diff(known, axis=2) <= 0.0).all()
        np.testing.assert_array_equal(after[:, :, -1], outcome.costs_km)
        assert all(history[-1][0] <= outcome.entrant.evaluations for row in outcome.histories for history in row)


def test_swarms_do_not_begin_at_the_straight_line(small: Study) -> None:
    hybrid = small.outcomes[0]
    first = np.array([[history[0][1] for history in row] for row in hybrid.histories])
    assert (first > 1.1 * hybrid.costs_km).all()


def test_seeds_differ_and_a_seed_repeats(small: Study) -> None:
    pso = next(outcome for outcome in small.outcomes if outcome.entrant.method == "pso")
    assert pso.costs_km[0, 0] != pso.costs_km[1, 0]
    again = study(small.scenario, (4,), lambda _: None)
    for before, after in zip(small.outcomes, again.outcomes, strict=True):
        assert before.histories[1] == after.histories[0]


def test_progress_ends_at_one(small: Study) -> None:
    del small
    assert PROGRESS[-1] == 1.0
    assert np.diff(PROGRESS).min() > 0.0


def test_a_search_without_a_path_counts_as_infinite_and_never_settles() -> None:
    entrant = Entrant("pso", 2, 300, ("iterations",))
    lost = ((150, INFEASIBLE_KM + 9.0), (300, INFEASIBLE_KM + 7.0))
    found = ((150, INFEASIBLE_KM + 9.0), (200, 40.3), (250, 40.2), (300, 40.0))
    outcome = Outcome(entrant, np.array([[np.inf, 40.0]]), ((lost, found),))
    assert np.isinf(outcome.totals_km).all()
    np.testing.assert_array_equal(outcome.best_after_km([100, 220, 300])[0], [[np.inf] * 3, [np.inf, 40.3, 40.0]])
    assert np.isnan(outcome.settled()[0, 0])
    assert outcome.settled()[0, 1] == 200
