"""What is compared: methods, each with its budget, so that iterations or evaluations are equal."""

from dataclasses import dataclass
from typing import Literal

from missions.scenario import Scenario
from planner.find_path import EVALUATIONS, SKEIN

Equal = Literal["iterations", "evaluations"]


@dataclass(frozen=True)
class Entrant:
    """A method with a budget.

    Attributes:
        method: one of `planner.find_path.METHODS`.
        iterations: of the budget; None for a method without. Of a swarm's, the last is cut short by as much as the
            first swarm took to evaluate.
        evaluations: the budget for one UAV.
        equal: what it has in common with the hybrid.
    """

    method: str
    iterations: int | None
    evaluations: int
    equal: tuple[Equal, ...]

    @property
    def name(self) -> str:
        """The method, and how long it may search."""
        return self.method if self.iterations is None else f"{self.method}, {self.iterations} iterations"


def entrants(scenario: Scenario) -> tuple[Entrant, ...]:
    """All that are compared on a scenario, the paper's hybrid first.

    The paper counts iterations. One costs the hybrid three evaluations of each particle, PSO and QPSO one. So these two
    take part twice: with the hybrid's iterations, and with its evaluations, which are three times as many iterations.
    """
    particles, iterations = scenario.search.population, scenario.search.iterations
    budget = particles * iterations * EVALUATIONS
    return (
        *(Entrant(method, iterations, budget, ("iterations", "evaluations")) for method in ("hybrid", "published")),
        *(Entrant(method, iterations, particles * iterations, ("iterations",)) for method in ("pso", "qpso")),
        *(Entrant(method, iterations * EVALUATIONS, budget, ("evaluations",)) for method in ("pso", "qpso")),
        Entrant(SKEIN, None, budget, ("evaluations",)),
    )
