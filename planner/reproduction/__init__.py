"""The paper's comparison of searches, made at equal iterations and at equal evaluations."""

from planner.reproduction.entrants import Entrant, entrants
from planner.reproduction.study import Outcome, Study, study

__all__ = ["Entrant", "Outcome", "Study", "entrants", "study"]
