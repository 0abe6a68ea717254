"""The paper's figures 4 to 12, and one more a scenario: what the paper's figures 8 and 12 are compared with."""

from collections.abc import Mapping
from pathlib import Path

from gcs.figures.fitness import draw_fitness
from gcs.figures.methods import draw_methods
from gcs.figures.projections import Plane, draw_projection
from gcs.figures.scene import USUAL, View, draw_scene
from gcs.reproduction import Reproduced

SCENES: Mapping[str, tuple[int, tuple[View, ...]]] = {
    "mountains": (4, (USUAL,)),
    "radars": (9, (USUAL, View(above=32, about=-62))),
}
PROJECTIONS: Mapping[str, Mapping[int, Plane]] = {
    "mountains": {5: "xy", 6: "xz", 7: "yz"},
    "radars": {10: "xy", 11: "yz"},
}
FITNESS: Mapping[str, int] = {"mountains": 8, "radars": 12}
"""Numbers of the paper's figures, by scenario."""


def draw_paper(reproduced: Reproduced, folder: Path) -> list[Path]:
    """Draw a scenario's figures into an existing folder; returns the files. Raises OSError."""
    scenario, plan, study = reproduced.scenario, reproduced.hybrid, reproduced.study
    truths = None if reproduced.flown is None else reproduced.flown.truths
    done = "the hybrid's plan" if truths is None else "the hybrid, planned and flown"
    files = []

    def file(number: int) -> Path:
        files.append(folder / f"figure-{number:02}.png")
        return files[-1]

    number, views = SCENES[scenario.name]
    title = f"Figure {number}: {scenario.name}, the hybrid's {'plan' if truths is None else 'flight'}"
    draw_scene(plan, scenario, truths, file(number), views=views, headline=title)
    for number, plane in PROJECTIONS[scenario.name].items():
        title = f"Figure {number}: {scenario.name} in the {plane} plane, {done}"
        draw_projection(plan, scenario, truths, plane, title, file(number))
    number, hybrid = FITNESS[scenario.name], study.outcomes[0]
    title = f"Figure {number}: {scenario.name}, fitness of all UAVs, {hybrid.entrant.method}, seed {study.seeds[0]}"
    draw_fitness(scenario, hybrid, scenario.search.population, 0, title, file(number))
    files.append(folder / f"methods-{scenario.name}.png")
    seeds = f"median and quartiles of {len(study.seeds)} seeds" if len(study.seeds) > 1 else "one seed"
    draw_methods(study, f"{scenario.name}: all methods from random first swarms, {seeds}", files[-1])
    return files
