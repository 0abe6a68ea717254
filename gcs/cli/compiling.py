"""Compiling before the first flight, with a word of it: it takes some 20 s once, and nobody shall think it hangs."""

from gcs.cli.progress import working
from gcs.rehearsal import compile_rehearsal
from missions.compiled import compiled_before
from missions.scenario import Scenario
from planner.formation_plan import FormationPlan


def compile_with_progress(scenario: Scenario, plan: FormationPlan) -> float:
    """`gcs.rehearsal.compile_rehearsal`, and that it takes long if it does. Raises InputError."""
    known = compiled_before("rehearsal")
    what = "Reading the compiled rehearsal" if known else "Compiling the rehearsal: some 20 s, the first time only"
    with working(what, brief=known):
        return compile_rehearsal(scenario, plan)
