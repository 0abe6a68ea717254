from missions.scenario import load_scenario
from planner.reproduction import entrants


def test_pso_and_qpso_share_the_hybrids_iterations_once_and_its_evaluations_once() -> None:
    hybrid, published, *others = entrants(load_scenario("radars"))
    assert (hybrid.method, hybrid.iterations, hybrid.evaluations) == ("hybrid", 200, 90_000)
    assert (published.iterations, published.evaluations) == (hybrid.iterations, hybrid.evaluations)
    for method in ("pso", "qpso"):
        at_iterations, at_evaluations = (one for one in others if one.method == method)
        assert (at_iterations.iterations, at_iterations.evaluations) == (200, 30_000)
        assert (at_evaluations.iterations, at_evaluations.evaluations) == (600, 90_000)


def test_whoever_is_compared_at_equal_evaluations_has_as_many_as_the_hybrid() -> None:
    field = entrants(load_scenario("mountains"))
    assert {one.evaluations for one in field if "evaluations" in one.equal} == {field[0].evaluations}
    assert {one.iterations for one in field if "iterations" in one.equal} == {field[0].iterations}
